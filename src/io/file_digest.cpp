#include "io/file_digest.h"

#include <array>
#include <fstream>
#include <memory>
#include <openssl/evp.h>
#include <stdexcept>
#include <vector>

#include "common/error.h"

namespace pounding {
namespace {

constexpr std::size_t block_size = 1 << 20;  // bytes

void require(int done) {
  if (done != 1) throw std::runtime_error("the library of hashes failed");
}

}  // namespace

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
