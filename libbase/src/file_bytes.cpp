// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cerrno>
#include <new>
#include <system_error>

#include <base/error.h>
#include <base/file_bytes.h>
#include <base/internal/system.h>

#include "wait_for_descriptor.h"

namespace meshrepair {
namespace {

// Some milliseconds of work, so that there is time to ask in between.
constexpr std::size_t kBytesAtOnce = std::size_t{4} << 20;

class Descriptor {
 public:
  Descriptor(int number, bool owned) : number_(number), owned_(owned) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() {
    if (owned_) internal::close_file(number_);
  }
  [[nodiscard]] int number() const { return number_; }

 private:
  int number_;
  bool owned_;
};

[[noreturn]] void fail(const std::string& name, const std::string& what, int error) {
  throw InputError(name + ": " + what + ": " + std::generic_category().message(error));
}

// A pipe that nobody writes into yet would be waited for while it is opened, where nobody can be
// asked.
int open_to_read(const std::filesystem::path& path, bool at_once) {
  using internal::FileUse;
  return internal::open_file(path, at_once ? FileUse::read_at_once : FileUse::read);
}

}  // namespace

FileBytes::FileBytes(const std::filesystem::path& path, ProgressObserver* progress) {
  const bool is_stdin = path == "-";
  const std::string name = is_stdin ? "standard input" : path.string();
  const int number = is_stdin ? internal::kStandardInput : open_to_read(path, progress != nullptr);
  const int error = errno;
  const internal::FileFacts facts =
      number < 0 ? internal::facts_of_file(path) : internal::facts_of_file(number);
  if (facts.kind == internal::FileKind::folder)
    throw InputError(name + ": is a folder, not a file");
  if (number < 0) fail(name, "cannot be opened", error);
  const Descriptor file(number, !is_stdin);

  if (facts.kind == internal::FileKind::none) fail(name, "cannot be read", errno);
  // One byte more than there should be, to see the end without another step.
  if (facts.kind == internal::FileKind::regular) {
    reserve(static_cast<std::size_t>(facts.bytes) + 1);
  }
  read_to_end(number, name, progress);
}

void FileBytes::reserve(std::size_t capacity) {
  char* const moved = static_cast<char*>(resize_block(buffer_.get(), size_, capacity));
  if (moved == nullptr) throw std::bad_alloc();
  static_cast<void>(buffer_.release());
  buffer_.reset(moved);
  capacity_ = capacity;
}

void FileBytes::read_to_end(int descriptor, const std::string& name, ProgressObserver* progress) {
  for (;;) {
    if (size_ == capacity_) reserve(2 * capacity_ + kBytesAtOnce);
    if (progress != nullptr) wait_for_descriptor(descriptor, internal::Direction::in, *progress);
    const std::size_t room = std::min(capacity_ - size_, kBytesAtOnce);
    const std::ptrdiff_t count = internal::read_some(descriptor, buffer_.get() + size_, room);
    // With nobody to ask, an interrupted read is an error like any other: a program that handles
    // signals is to stop then, and a read begun anew would wait on.
    if (count < 0 && errno == EINTR && progress != nullptr) continue;
    if (count < 0) fail(name, "cannot be read", errno);
    if (count == 0) return;
    size_ += static_cast<std::size_t>(count);
  }
}

}  // namespace meshrepair
