// SPDX-License-Identifier: MIT
// Makes a ZIP archive in memory: the same entries give the same bytes.
#pragma once

#include <deque>
#include <memory>
#include <string>
#include <string_view>

struct zip;
struct zip_source;

namespace meshrepair {

class ZipWriter {
 public:
  // All functions throw OutputError when libzip refuses.
  ZipWriter();
  ~ZipWriter();
  ZipWriter(const ZipWriter&) = delete;
  ZipWriter& operator=(const ZipWriter&) = delete;

  // The bytes have to stay until the end. What is packed already is only stored.
  void add(const std::string& name, std::string_view bytes, bool is_packed);
  // The same, for bytes that nobody else keeps.
  void add_text(const std::string& name, std::string text);

  // The archive; to be called once.
  [[nodiscard]] std::string finish();

 private:
  struct FreeSource {
    void operator()(zip_source* source) const;
  };
  struct DiscardArchive {
    void operator()(zip* archive) const;
  };

  std::deque<std::string> texts_;
  std::unique_ptr<zip_source, FreeSource> target_;
  std::unique_ptr<zip, DiscardArchive> archive_;
};

}  // namespace meshrepair
