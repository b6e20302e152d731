#include "io/schema.h"

#include <stdexcept>

#include "common/facts.h"
#include "common/version.h"

namespace pounding::schema {
namespace {

/// The schema of a file as it states it; "without a schema number" of one that does not.
std::string schema_of(const Hdf5Reader& file) {
  for (const char* attribute : {"schema", "version"}) {
    try {
      return sentence("of schema {}", {file.number("/", attribute)});
    } catch (const std::runtime_error&) {
      continue;
    }
  }
  return "without a schema number";
}

std::string program_of(const Hdf5Reader& file) {
  try {
    return ", written by pounding " + file.text("/", "program");
  } catch (const std::runtime_error&) {
    return ", written by an earlier version";
  }
}

}  // namespace

void write(Hdf5File& file, int number) {
  file.write_attribute("/", "schema", number);
  file.write_attribute("/", "program", program_version());
}

void require(const Hdf5Reader& file, int number) {
  const std::string found = schema_of(file);
  const std::string wanted = "schema " + std::to_string(number);
  if (found == "of " + wanted) return;
  throw std::runtime_error(found + program_of(file) + "; this program reads " + wanted);
}

}  // namespace pounding::schema
