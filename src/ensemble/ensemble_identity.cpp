#include "ensemble/ensemble_identity.h"

#include <filesystem>
#include <set>

#include "common/parallel.h"
#include "io/file_digest.h"
#include "scene/resolved_options.h"

namespace pounding {
namespace {

bool counts(const std::string& name) {
  return !may_differ(name, Comparison::ensemble) && !name.ends_with("_modal_basis");
}

bool names_content(const std::string& name) {
  return name.ends_with("_mesh") || name.ends_with("_record") || name.ends_with("_target") ||
         name.ends_with("_soil_table");
}

}  // namespace

std::vector<std::string> ensemble_identity(const std::string& resolved, const MemberTable& table) {
  std::vector<std::string> lines;
  for (const auto& [name, value] : resolved_values(resolved)) {
    if (counts(name)) lines.push_back("option " + name + " " + value);
  }
  std::string columns = "columns";
  for (const std::string& column : table.columns) columns += " " + column;
  lines.push_back(columns);
  for (std::size_t m = 0; m < table.members(); ++m) {
    std::string line = "member " + std::to_string(m + 1);
    for (std::size_t c = 0; c < table.columns.size(); ++c) line += " | " + table.value(m, c);
    lines.push_back(line);
  }
  return lines;
}

std::vector<std::string> identity_of_files(MPI_Comm comm, const std::string& resolved,
                                           const MemberTable& table,
                                           const std::vector<std::string>& opened) {
  std::set<std::string> files(opened.begin(), opened.end());
  const auto take_file = [&](const std::string& name, const std::string& value) {
    if (names_content(name) && !value.empty() && value != "none") files.insert(value);
  };
  for (const auto& [name, value] : resolved_values(resolved)) {
    if (counts(name)) take_file(name, value);
  }
  for (std::size_t m = 0; m < table.members(); ++m) {
    for (std::size_t c = 0; c < table.columns.size(); ++c) {
      take_file(table.columns[c], table.value(m, c));
    }
  }
  std::vector<std::string> lines;
  std::string digests;
  on_rank0(comm, [&] {
    for (const std::string& file : files) {
      std::error_code failure;
      if (!std::filesystem::is_regular_file(file, failure)) continue;
      digests += "file " + file + " " + digest_of_file(file).sha256 + "\n";
    }
  });
  broadcast(comm, digests);
  for (std::size_t begin = 0; begin < digests.size();) {
    const std::size_t end = digests.find('\n', begin);
    lines.push_back(digests.substr(begin, end - begin));
    begin = end + 1;
  }
  return lines;
}

}  // namespace pounding
