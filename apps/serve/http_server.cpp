// SPDX-License-Identifier: MIT
#include "serve/http_server.h"

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/steady_timer.hpp>
#include <chrono>
#include <memory>
#include <string>
#include <utility>

#include <base/error.h>

#include "serve/http_connection.h"

namespace meshrepair {
namespace {

namespace asio = boost::asio;
using Tcp = asio::ip::tcp;

constexpr std::chrono::milliseconds kBetweenQuestions(100);
constexpr std::chrono::milliseconds kAfterFailure(100);  // to accept: no descriptors are left

}  // namespace

class HttpServer::Listener {
 public:
  explicit Listener(unsigned short port) : acceptor_(context_), timer_(context_), pause_(context_) {
    const Tcp::endpoint here(asio::ip::address_v4::loopback(), port);
    boost::system::error_code error;
    acceptor_.open(here.protocol());
    acceptor_.set_option(asio::socket_base::reuse_address(true));
    acceptor_.bind(here, error);
    if (!error) acceptor_.listen(asio::socket_base::max_listen_connections, error);
    if (error) {
      throw UsageError("--port: " + std::to_string(port) +
                       " cannot be listened to: " + error.message());
    }
  }

  [[nodiscard]] unsigned short port() const { return acceptor_.local_endpoint().port(); }

  void serve(const Answers& answers, const Limits& limits, const std::function<bool()>& ended) {
    answers_ = &answers;
    limits_ = &limits;
    ended_ = &ended;
    accept();
    look();
    context_.run();
  }

 private:
  void accept() {
    acceptor_.async_accept([this](const boost::system::error_code& error, Tcp::socket socket) {
      if (error == asio::error::operation_aborted) return;
      if (error) return accept_later();
      const bool is_full = connections_ >= limits_->connections;
      const auto connection =
          std::make_shared<HttpConnection>(std::move(socket), *answers_, *limits_, connections_);
      if (is_full) {
        connection->turn_away();
      } else {
        connection->start();
      }
      accept();
    });
  }

  void accept_later() {
    pause_.expires_after(kAfterFailure);
    pause_.async_wait([this](const boost::system::error_code& error) {
      if (!error) accept();
    });
  }

  void look() {
    if ((*ended_)()) return context_.stop();
    timer_.expires_after(kBetweenQuestions);
    timer_.async_wait([this](const boost::system::error_code& error) {
      if (!error) look();
    });
  }

  std::size_t connections_ = 0;  // they count themselves, also when the context goes
  asio::io_context context_{1};
  Tcp::acceptor acceptor_;
  asio::steady_timer timer_, pause_;
  const Answers* answers_ = nullptr;
  const Limits* limits_ = nullptr;
  const std::function<bool()>* ended_ = nullptr;
};

HttpServer::HttpServer(unsigned short port) : listener_(std::make_unique<Listener>(port)) {}

HttpServer::~HttpServer() = default;

unsigned short HttpServer::port() const { return listener_->port(); }

void HttpServer::serve(const Answers& answers, const Limits& limits,
                       const std::function<bool()>& ended) {
  listener_->serve(answers, limits, ended);
}

}  // namespace meshrepair
