// SPDX-License-Identifier: MIT
// XML as a stream: elements and texts are told one by one, as the bytes come in.
#pragma once

#include <cstddef>
#include <exception>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include <mesh/mesh_source.h>

struct XML_ParserStruct;

namespace meshrepair {

// Of one element.
class XmlAttributes {
 public:
  // Pairs of names and values, a null pointer at the end.
  explicit XmlAttributes(const char** pairs) : pairs_(pairs) {}

  // Names without a namespace are local; others are "namespace|local".
  [[nodiscard]] std::optional<std::string_view> find(std::string_view name) const;
  // Empty if it is not there.
  [[nodiscard]] std::string text(std::string_view name) const;

  // Calls visit(name, value) for each.
  template <class Visit>
  void visit(const Visit& visit_pair) const {
    for (const char** pair = pairs_; *pair != nullptr; pair += 2) {
      visit_pair(std::string_view(pair[0]), std::string_view(pair[1]));
    }
  }

 private:
  const char** pairs_;
};

// What it throws stops the stream and comes out of it.
class XmlHandler {
 public:
  XmlHandler() = default;
  XmlHandler(const XmlHandler&) = delete;
  XmlHandler& operator=(const XmlHandler&) = delete;
  virtual ~XmlHandler() = default;

  // `space` is the namespace, as text.
  virtual void start(std::string_view space, std::string_view name,
                     const XmlAttributes& attributes) = 0;
  virtual void end() {}
  virtual void text(std::string_view /*piece*/) {}
  // A namespace that the outermost element declares; an empty prefix is the default.
  virtual void declare(std::string_view /*prefix*/, std::string_view /*space*/) {}
};

class XmlStream {
 public:
  // Prefixes that no namespace is declared for are an error, or part of plain names.
  enum class Names { in_spaces, plain };

  // `part` is the name for messages. All have to stay.
  XmlStream(const MeshSource& source, std::string part, XmlHandler& handler,
            Names names = Names::in_spaces);
  ~XmlStream();
  XmlStream(const XmlStream&) = delete;
  XmlStream& operator=(const XmlStream&) = delete;

  // Both throw InputError where it is no XML that can be taken: not well-formed, with a document
  // type, nested too deep, with one tag of a megabyte.
  void feed(std::string_view bytes);
  void finish();

  // Of the tag that is told: where it begins in all that was fed, and how long it is. At the end of
  // an empty element, that of its only tag is over: it is 0 bytes long.
  struct Span {
    std::size_t at = 0, size = 0;

    [[nodiscard]] std::size_t end() const { return at + size; }
  };
  [[nodiscard]] Span tag() const;

  // Throws InputError "NAME: PART:LINE: what" for where the stream is.
  [[noreturn]] void fail(const std::string& what) const;

 private:
  struct Callbacks;

  void parse(std::string_view bytes, bool last);

  const MeshSource& source_;
  std::string part_;
  XmlHandler& handler_;
  std::unique_ptr<XML_ParserStruct, void (*)(XML_ParserStruct*)> parser_;
  std::exception_ptr thrown_;
  std::size_t depth_ = 0;
  std::size_t fed_ = 0;
};

}  // namespace meshrepair
