#include "io/schema.h"

#include <sstream>
#include <stdexcept>

#include "common/version.h"

namespace pounding::schema {
namespace {

/// The schema of a file as it states it; "without a schema number" of one that does not.
std::string schema_of(const Hdf5Reader& file) {
  for (const char* attribute : {"schema", "version"}) {
    try {
      std::ostringstream text;
      text << "of schema " << file.number("/", attribute);
      return text.str();
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
