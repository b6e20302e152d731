#include "io/file_seal.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <fcntl.h>
#include <fstream>
#include <memory>
#include <openssl/evp.h>
#include <stdexcept>
#include <unistd.h>
#include <zlib.h>

#include "common/error.h"

namespace pounding {
namespace {

constexpr auto first_byte = static_cast<std::int64_t>(seal_size);
constexpr std::int64_t largest_offset = 1LL << 56;  ///< that is believed

/// Adds bytes of a file to a sum, which ends early where they cannot be read.
void add_bytes(std::ifstream& file, std::int64_t first, std::int64_t end, uLong& sum) {
  std::vector<char> block(1 << 20);
  file.seekg(first);
  while (first < end && file) {
    file.read(block.data(), std::min<std::int64_t>(end - first, std::ssize(block)));
    sum =
        crc32(sum, reinterpret_cast<const Bytef*>(block.data()), static_cast<uInt>(file.gcount()));
    first += file.gcount();
  }
}

/// The seal that the bytes of a file behind its first 512 ask for; nothing if they cannot be read
/// to their end, or if the ranges do not lie in them one behind the other. Ranges that touch become
/// one.
std::string seal_of(std::ifstream& file, const std::vector<OpenBytes>& open) {
  file.seekg(0, std::ios::end);
  const std::int64_t size = file.tellg();
  uLong sum = crc32(0, nullptr, 0);
  std::int64_t offset = first_byte;
  std::string lines;
  for (std::size_t i = 0; i < open.size(); ++i) {
    OpenBytes one = open[i];
    while (i + 1 < open.size() && open[i + 1].first == one.first + one.bytes) {
      one.bytes += open[++i].bytes;
    }
    if (one.first < offset || one.bytes < 0 || one.bytes > size - one.first) return "";
    add_bytes(file, offset, one.first, sum);
    offset = one.first + one.bytes;
    lines += "open " + std::to_string(one.first) + " " + std::to_string(one.bytes) + "\n";
  }
  add_bytes(file, offset, size, sum);
  if (!file) return "";
  std::array<char, 80> head{};
  std::snprintf(head.data(), head.size(), "pounding seal 1\nbytes %lld\ncrc32 %08lx\n",
                static_cast<long long>(size - first_byte), static_cast<unsigned long>(sum));
  return head.data() + lines;
}

/// The first bytes of a file, padding included; empty if it is shorter.
std::string head_of(std::ifstream& file) {
  std::string head(seal_size, '\0');
  file.read(head.data(), std::ssize(head));
  return file ? head : "";
}

std::vector<OpenBytes> ranges_in(const std::string& head) {
  std::vector<OpenBytes> ranges;
  for (std::size_t at = head.find("\nopen "); at != std::string::npos;
       at = head.find("\nopen ", at + 1)) {
    long long first = 0;
    long long bytes = 0;
    if (std::sscanf(head.c_str() + at, "\nopen %lld %lld\n", &first, &bytes) != 2) break;
    if (std::max(first, bytes) > largest_offset || std::min(first, bytes) < 0) break;
    ranges.push_back({first, bytes});
  }
  return ranges;
}

constexpr std::size_t block_size = 1 << 20;  // bytes

void require(int done) {
  if (done != 1) throw std::runtime_error("the library of hashes failed");
}

}  // namespace

void seal_file(const std::string& path, std::vector<OpenBytes> open) {
  std::ranges::sort(open, {}, &OpenBytes::first);
  std::ifstream content(path, std::ios::binary);
  std::string seal = seal_of(content, open);
  const bool readable = !seal.empty();
  if (seal.size() > seal_size) throw std::logic_error(path + ": too many places are left open");
  seal.resize(seal_size, '\0');
  const int file = ::open(path.c_str(), O_WRONLY | O_CLOEXEC | O_NOFOLLOW);
  const bool written =
      readable && file >= 0 &&
      pwrite(file, seal.data(), seal.size(), 0) == static_cast<ssize_t>(seal_size) &&
      fsync(file) == 0;
  if (file >= 0) close(file);
  if (!written) throw UserError(path + ": could not be written completely (is the disk full?)");
}

std::vector<OpenBytes> open_bytes(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return ranges_in(head_of(file));
}

void check_seal(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  const std::string written = head_of(file);
  if (!written.starts_with("pounding seal")) {
    throw std::runtime_error(
        path +
        ": not a checkpoint, modal basis, piece of a mesh or ensemble: it does not begin with "
        "the seal of one; another file, of an older version, or damaged");
  }
  std::string due = seal_of(file, ranges_in(written));
  due.resize(seal_size, '\0');
  if (due != written) {
    throw std::runtime_error(path +
                             ": its content is not the sealed one; it is damaged, or it was "
                             "changed and not sealed anew (run/seal; pounding-tools seal)");
  }
}

FileDigest digest_of_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  const std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)> context(EVP_MD_CTX_new(),
                                                                        &EVP_MD_CTX_free);
  require(EVP_DigestInit_ex(context.get(), EVP_sha256(), nullptr));
  FileDigest digest;
  std::vector<char> block(block_size);
  while (file) {
    file.read(block.data(), static_cast<std::streamsize>(block.size()));
    const auto count = static_cast<std::size_t>(file.gcount());
    require(EVP_DigestUpdate(context.get(), block.data(), count));
    digest.bytes += count;
  }
  if (!file.eof()) throw UserError(path + ": no such file, or it cannot be read");
  std::array<unsigned char, EVP_MAX_MD_SIZE> hash{};
  unsigned length = 0;
  require(EVP_DigestFinal_ex(context.get(), hash.data(), &length));
  constexpr const char* digits = "0123456789abcdef";
  for (unsigned i = 0; i < length; ++i) {
    digest.sha256 += digits[hash[i] >> 4U];
    digest.sha256 += digits[hash[i] & 0xfU];
  }
  return digest;
}

}  // namespace pounding
