// SPDX-License-Identifier: MIT
#include "serve/http_connection.h"

#include <array>
#include <cerrno>
#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <spdlog/logger.h>

#include "serve/own_folder.h"
#include "terminal/logging.h"

namespace meshrepair {
namespace {

namespace beast = boost::beast;
namespace http = beast::http;

constexpr std::size_t kMostHead = 16384;  // bytes
constexpr std::size_t kPiece = std::size_t{1} << 18;
constexpr std::chrono::seconds kFarewell(3);
// The system says that there is room for more when a part of this is free: with a larger buffer, it
// would be silent for long to a slow reader, who does get bytes.
constexpr int kSendBuffer = 1 << 17;

std::string_view view(beast::string_view text) { return {text.data(), text.size()}; }

template <class Fields>
Request request_of(const Fields& message) {
  Request request;
  request.method = view(message.method_string());
  request.target = view(message.target());
  request.options = view(message["X-Meshrepair-Options"]);
  request.sender.host = view(message[http::field::host]);
  request.sender.origin = view(message[http::field::origin]);
  request.sender.fetch_site = view(message["Sec-Fetch-Site"]);
  request.sender.token = view(message["X-Meshrepair-Token"]);
  return request;
}

// Why the bytes of a request cannot be told apart, or what it says of itself; nothing: they can.
std::optional<Answer> refusal_of_form(const http::request_parser<http::empty_body>& head) {
  const auto& message = head.get();
  constexpr std::array<beast::string_view, 5> kOnce = {
      "Host", "Origin", "Sec-Fetch-Site", "X-Meshrepair-Token", "X-Meshrepair-Options"};
  for (const beast::string_view name : kOnce) {
    if (message.count(name) > 1) return refused(400, "there are two headers " + name.to_string());
  }
  const bool is_coded = message.count(http::field::transfer_encoding) > 0;
  if (is_coded && (message.count(http::field::transfer_encoding) > 1 ||
                   !beast::iequals(message[http::field::transfer_encoding], "chunked"))) {
    return refused(501, "of transfer codings this server knows chunked alone");
  }
  return std::nullopt;
}

template <class Contents>
void add_headers(http::response<Contents>& message, const Answer& answer) {
  message.set(http::field::content_type, answer.type);
  message.set(http::field::cache_control, "no-store");
  message.set("X-Content-Type-Options", "nosniff");
  message.set("Referrer-Policy", "no-referrer");
  message.set("Cross-Origin-Resource-Policy", "same-origin");
  message.set("Cross-Origin-Opener-Policy", "same-origin");
  for (const auto& [name, value] : answer.headers) message.set(name, value);
}

}  // namespace

HttpConnection::HttpConnection(Socket socket, const Answers& answers,
                               const HttpServer::Limits& limits, std::size_t& count)
    : stream_(std::move(socket)), answers_(answers), limits_(limits), count_(count) {
  ++count_;
  Error none;
  stream_.socket().set_option(boost::asio::socket_base::send_buffer_size(kSendBuffer), none);
}

// An upload that was not whole does not stay.
HttpConnection::~HttpConnection() {
  if (intake_) answers_.discard_upload(*intake_);
  --count_;
}

void HttpConnection::turn_away() {
  send(refused(503, "too many requests at a time: try again"), false);
}

void HttpConnection::read_head() {
  head_.emplace();
  head_->header_limit(kMostHead);
  head_->body_limit(limits_.body);
  stream_.expires_after(std::chrono::seconds(limits_.seconds_for_head));
  http::async_read_header(
      stream_, buffer_, *head_,
      [self = shared_from_this()](const Error& error, std::size_t) { self->take_head(error); });
}

void HttpConnection::take_head(const Error& error) {
  if (error == http::error::body_limit) {
    return send(refused(413, "the mesh is larger than this server takes"), false);
  }
  if (error) return close();
  if (const auto refusal = refusal_of_form(*head_)) return send(*refusal, false);
  const Request request = request_of(head_->get());
  if (Answers::is_upload(request)) {
    const bool has_end = head_->content_length() || head_->chunked();
    if (!has_end) return send(refused(411, "the length of the mesh is missing"), false);
    return take_upload(answers_.begin_upload(request));
  }
  // No other request has a body that matters; one that is sent all the same is not read.
  const bool has_body = head_->content_length().value_or(0) > 0 || head_->chunked();
  send(answers_.answer(request), head_->keep_alive() && !has_body);
}

void HttpConnection::take_upload(Answers::Upload upload) {
  if (!upload.intake) return send(upload.refusal, false);
  intake_ = std::move(upload.intake);
  Error error;
  file_.open(intake_->file.c_str(), beast::file_mode::write_new, error);
  if (error) return fail_upload(refused(507, "the mesh cannot be kept"));
  body_.emplace(std::move(*head_));
  body_->body_limit(limits_.body);
  piece_.resize(kPiece);
  if (body_->is_done()) return end_upload();  // of no bytes: none would come
  read_body();
}

void HttpConnection::read_body() {
  body_->get().body().data = piece_.data();
  body_->get().body().size = piece_.size();
  stream_.expires_after(std::chrono::seconds(limits_.seconds_without_byte));
  http::async_read_some(
      stream_, buffer_, *body_,
      [self = shared_from_this()](const Error& error, std::size_t) { self->take_body(error); });
}

void HttpConnection::take_body(Error error) {
  if (error == http::error::need_buffer) error = {};
  if (error == http::error::body_limit) {
    return fail_upload(refused(413, "the mesh is larger than this server takes"));
  }
  if (error) return close();
  const std::size_t count = piece_.size() - body_->get().body().size;
  if (!keep_piece(count)) return fail_upload(refused(507, "there is no room for the mesh"));
  if (!body_->is_done()) return read_body();
  end_upload();
}

// A disk that is full has room for it once older meshes are gone.
bool HttpConnection::keep_piece(std::size_t count) {
  Error error;
  const std::uint64_t begin = file_.pos(error);
  if (error) return false;
  for (;;) {
    file_.write(piece_.data(), count, error);
    if (!error) return true;
    const bool is_full =
        error == boost::system::errc::no_space_on_device || error.value() == EDQUOT;
    if (!is_full || !answers_.free_room()) return false;
    file_.seek(begin, error);
    if (error) return false;
  }
}

void HttpConnection::end_upload() {
  Error error;
  file_.close(error);
  if (error) return fail_upload(refused(507, "there is no room for the mesh"));
  const Workshop::Intake intake = *std::exchange(intake_, std::nullopt);
  send(answers_.end_upload(intake), body_->keep_alive());
}

void HttpConnection::fail_upload(const Answer& refusal) {
  if (intake_) answers_.discard_upload(*std::exchange(intake_, std::nullopt));
  send(refusal, false);
}

void HttpConnection::send(const Answer& answer, bool keeps) {
  const unsigned version = 11;
  const bool is_head =
      head_ && head_->is_header_done() && head_->get().method() == http::verb::head;
  if (answer.file.empty() || is_head) {
    auto message = std::make_shared<http::response<http::string_body>>(
        static_cast<http::status>(answer.status), version);
    add_headers(*message, answer);
    if (!is_head) message->body() = answer.body;
    message->keep_alive(keeps);
    message->prepare_payload();
    return write(message, keeps);
  }
  auto message = std::make_shared<http::response<http::file_body>>(
      static_cast<http::status>(answer.status), version);
  Error error;
  beast::file_posix file;
  file.native_handle(open_plain_file(answer.file));
  if (!file.is_open()) return send(refused(404, "it is not there any more"), keeps);
  message->body().reset(std::move(file), error);
  if (error) return send(refused(500, "it cannot be read"), false);
  add_headers(*message, answer);
  message->keep_alive(keeps);
  message->prepare_payload();
  write(message, keeps);
}

template <class Contents>
void HttpConnection::write(const std::shared_ptr<Message<Contents>>& message, bool keeps) {
  write_piece(message, std::make_shared<Serializer<Contents>>(*message), keeps);
}

// Piece by piece, each with the time for one: how long all of it takes is up to the reader.
template <class Contents>
void HttpConnection::write_piece(const std::shared_ptr<Message<Contents>>& message,
                                 const std::shared_ptr<Serializer<Contents>>& serializer,
                                 bool keeps) {
  stream_.expires_after(std::chrono::seconds(limits_.seconds_without_byte));
  http::async_write_some(
      stream_, *serializer,
      [self = shared_from_this(), message, serializer, keeps](const Error& error, std::size_t) {
        if (!error && !serializer->is_done()) return self->write_piece(message, serializer, keeps);
        if (error || !keeps) return self->close();
        self->read_head();
      });
}

// What the other end still sends is read for a while: closed at once, it would never see the
// answer.
void HttpConnection::close() {
  Error none;
  stream_.socket().shutdown(Socket::shutdown_send, none);
  if (none) return;
  piece_.resize(kPiece);
  farewell_ = std::chrono::steady_clock::now() + kFarewell;
  drain();
}

void HttpConnection::drain() {
  stream_.expires_at(farewell_);
  stream_.async_read_some(boost::asio::buffer(piece_),
                          [self = shared_from_this()](const Error& error, std::size_t) {
                            if (!error) self->drain();
                          });
}

}  // namespace meshrepair
