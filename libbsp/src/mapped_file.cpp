#include "mapped_file.h"

#include <cerrno>
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>

#include <bsp/error.h>

namespace meshrepair {
namespace {

class Descriptor {
 public:
  Descriptor(int number, bool owned) : number_(number), owned_(owned) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() {
    if (owned_) ::close(number_);
  }
  [[nodiscard]] int number() const { return number_; }

 private:
  int number_;
  bool owned_;
};

[[noreturn]] void fail(const std::string& name, const std::string& what, int error) {
  throw InputError(name + ": " + what + ": " + std::generic_category().message(error));
}

// An interrupted read is an error like any other: signals are handled without SA_RESTART by
// programs that are to stop, and a read begun anew would wait on.
std::string read_to_end(int descriptor, const std::string& name) {
  constexpr std::size_t kStep = std::size_t{1} << 20;
  std::string bytes;
  std::size_t filled = 0;
  for (;;) {
    if (bytes.size() - filled < kStep) bytes.resize(2 * bytes.size() + kStep);
    const ssize_t count = ::read(descriptor, bytes.data() + filled, bytes.size() - filled);
    if (count < 0) fail(name, "cannot be read", errno);
    if (count == 0) break;
    filled += static_cast<std::size_t>(count);
  }
  bytes.resize(filled);
  return bytes;
}

}  // namespace

MappedFile::MappedFile(const std::filesystem::path& path) {
  const bool is_stdin = path == "-";
  const std::string name = is_stdin ? "standard input" : path.string();
  const int number = is_stdin ? STDIN_FILENO : ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (number < 0) fail(name, "cannot be opened", errno);
  const Descriptor file(number, !is_stdin);

  struct stat status {};
  if (::fstat(number, &status) != 0) fail(name, "cannot be read", errno);
  if (S_ISDIR(status.st_mode)) throw InputError(name + ": is a folder, not a file");
  // Standard input may stand in the middle of a file, so that it is read, never mapped.
  if (!is_stdin && S_ISREG(status.st_mode) && status.st_size > 0) {
    const auto size = static_cast<std::size_t>(status.st_size);
    void* const map = ::mmap(nullptr, size, PROT_READ, MAP_PRIVATE | MAP_POPULATE, number, 0);
    if (map != MAP_FAILED) {
      map_ = map;
      map_size_ = size;
      return;
    }
  }
  // Also for files that have no size or cannot be mapped, such as those of /proc.
  copy_ = read_to_end(number, name);
}

MappedFile::~MappedFile() {
  if (map_ != nullptr) ::munmap(map_, map_size_);
}

}  // namespace meshrepair
