// SPDX-License-Identifier: MIT
#include "xml_stream.h"

#include <algorithm>
#include <cstdint>
#include <expat.h>
#include <new>
#include <utility>

namespace meshrepair {
namespace {

// No name has it.
constexpr char kSeparator = '|';

// Metadata and elements of others may be nested, but not like this.
constexpr std::size_t kDeepestElement = 256;

// A tag is scanned again with each piece that comes in before it ends.
constexpr std::size_t kLongestTag = std::size_t{1} << 20;

// Each name in a namespace is copied with all of it.
constexpr std::size_t kLongestNamespace = 256;

void free_parser(XML_ParserStruct* parser) { XML_ParserFree(parser); }

}  // namespace

std::optional<std::string_view> XmlAttributes::find(std::string_view name) const {
  for (const char** pair = pairs_; *pair != nullptr; pair += 2) {
    if (name == pair[0]) return pair[1];
  }
  return std::nullopt;
}

std::string XmlAttributes::text(std::string_view name) const {
  return std::string(find(name).value_or(std::string_view()));
}

// What expat calls. No exception passes through it.
struct XmlStream::Callbacks {
  template <class Call>
  static void guarded(void* data, const Call& call) {
    auto& stream = *static_cast<XmlStream*>(data);
    if (stream.thrown_) return;
    try {
      call(stream);
    } catch (...) {
      stream.thrown_ = std::current_exception();
      XML_StopParser(stream.parser_.get(), XML_FALSE);
    }
  }

  static void start(void* data, const char* name, const char** attributes) {
    guarded(data, [&](XmlStream& stream) {
      if (++stream.depth_ > kDeepestElement) stream.fail("elements are nested too deep");
      std::string_view space, local = name;
      if (const std::size_t at = local.rfind(kSeparator); at != std::string_view::npos) {
        space = local.substr(0, at);
        local.remove_prefix(at + 1);
      }
      stream.handler_.start(space, local, XmlAttributes(attributes));
    });
  }

  static void end(void* data, const char* /*name*/) {
    guarded(data, [&](XmlStream& stream) {
      --stream.depth_;
      stream.handler_.end();
    });
  }

  static void text(void* data, const char* piece, int size) {
    guarded(data, [&](XmlStream& stream) {
      stream.handler_.text(std::string_view(piece, static_cast<std::size_t>(size)));
    });
  }

  static void declare(void* data, const char* prefix, const char* space) {
    guarded(data, [&](XmlStream& stream) {
      const std::string_view name = space == nullptr ? "" : space;
      if (name.size() > kLongestNamespace) stream.fail("the name of a namespace is too long");
      if (stream.depth_ == 0) stream.handler_.declare(prefix == nullptr ? "" : prefix, name);
    });
  }

  static void refuse_doctype(void* data, const char* /*name*/, const char* /*system*/,
                             const char* /*public_id*/, int /*has_internal_subset*/) {
    guarded(data, [&](XmlStream& stream) {
      stream.fail("has a document type (DOCTYPE), which is not allowed here");
    });
  }
};

XmlStream::XmlStream(const MeshSource& source, std::string part, XmlHandler& handler, Names names)
    : source_(source),
      part_(printable(part)),
      handler_(handler),
      parser_(names == Names::plain ? XML_ParserCreate(nullptr)
                                    : XML_ParserCreateNS(nullptr, kSeparator),
              &free_parser) {
  if (!parser_) throw std::bad_alloc();
  XML_SetUserData(parser_.get(), this);
  XML_SetElementHandler(parser_.get(), &Callbacks::start, &Callbacks::end);
  XML_SetCharacterDataHandler(parser_.get(), &Callbacks::text);
  XML_SetStartNamespaceDeclHandler(parser_.get(), &Callbacks::declare);
  XML_SetStartDoctypeDeclHandler(parser_.get(), &Callbacks::refuse_doctype);
}

XmlStream::~XmlStream() = default;

void XmlStream::feed(std::string_view bytes) {
  constexpr std::size_t kPiece = std::size_t{64} << 10;
  while (!bytes.empty()) {
    const std::string_view piece = bytes.substr(0, kPiece);
    parse(piece, false);
    bytes.remove_prefix(piece.size());
  }
}

void XmlStream::finish() { parse({}, true); }

void XmlStream::parse(std::string_view bytes, bool last) {
  const XML_Status status =
      XML_Parse(parser_.get(), bytes.data(), static_cast<int>(bytes.size()), last ? 1 : 0);
  fed_ += bytes.size();
  if (thrown_) std::rethrow_exception(std::exchange(thrown_, nullptr));
  if (status == XML_STATUS_ERROR) {
    const XML_Error error = XML_GetErrorCode(parser_.get());
    if (error == XML_ERROR_NO_MEMORY) throw std::bad_alloc();
    fail(std::string("is not readable XML: ") + XML_ErrorString(error));
  }
  const XML_Index at = XML_GetCurrentByteIndex(parser_.get());
  if (!last && at >= 0 && fed_ - std::min(fed_, static_cast<std::size_t>(at)) > kLongestTag) {
    fail("a tag or a comment is longer than a megabyte");
  }
}

XmlStream::Span XmlStream::tag() const {
  const XML_Index at = XML_GetCurrentByteIndex(parser_.get());
  const int size = XML_GetCurrentByteCount(parser_.get());
  return {static_cast<std::size_t>(std::max<XML_Index>(at, 0)),
          static_cast<std::size_t>(std::max(size, 0))};
}

void XmlStream::fail(const std::string& what) const {
  source_.fail(part_ + ":" + std::to_string(XML_GetCurrentLineNumber(parser_.get())) + ": " + what);
}

}  // namespace meshrepair
