// SPDX-License-Identifier: MIT
// One connection of the server: one request after the other.
#pragma once

#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <chrono>
#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "serve/answers.h"
#include "serve/http_server.h"

namespace meshrepair {

class HttpConnection : public std::enable_shared_from_this<HttpConnection> {
 public:
  using Socket = boost::asio::ip::tcp::socket;

  // Counted as long as it lives.
  HttpConnection(Socket socket, const Answers& answers, const HttpServer::Limits& limits,
                 std::size_t& count);
  HttpConnection(const HttpConnection&) = delete;
  HttpConnection& operator=(const HttpConnection&) = delete;
  ~HttpConnection();

  void start() { read_head(); }
  // There are too many: says so, and closes.
  void turn_away();

 private:
  using Error = boost::beast::error_code;
  using Head = boost::beast::http::request_parser<boost::beast::http::empty_body>;
  using Body = boost::beast::http::request_parser<boost::beast::http::buffer_body>;

  void read_head();
  void take_head(const Error& error);
  void take_upload(Answers::Upload upload);
  void read_body();
  void take_body(Error error);
  [[nodiscard]] bool keep_piece(std::size_t count);
  void end_upload();
  void fail_upload(const Answer& refusal);
  void send(const Answer& answer, bool keeps);
  template <class Contents>
  using Message = boost::beast::http::response<Contents>;
  template <class Contents>
  using Serializer = boost::beast::http::response_serializer<Contents>;
  template <class Contents>
  void write(const std::shared_ptr<Message<Contents>>& message, bool keeps);
  template <class Contents>
  void write_piece(const std::shared_ptr<Message<Contents>>& message,
                   const std::shared_ptr<Serializer<Contents>>& serializer, bool keeps);
  void close();
  void drain();

  boost::beast::tcp_stream stream_;
  boost::beast::flat_buffer buffer_;
  const Answers& answers_;
  const HttpServer::Limits& limits_;
  std::size_t& count_;
  std::optional<Head> head_;
  std::optional<Body> body_;
  std::optional<Workshop::Intake> intake_;  // that the body is written to
  boost::beast::file file_;
  std::vector<char> piece_;
  std::chrono::steady_clock::time_point farewell_;
};

}  // namespace meshrepair
