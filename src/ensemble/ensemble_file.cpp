#include "ensemble/ensemble_file.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <numeric>
#include <set>
#include <string_view>
#include <zlib.h>

#include "common/error.h"
#include "common/parallel.h"
#include "io/csv_file.h"
#include "io/file_seal.h"
#include "io/hdf5_file.h"
#include "io/hdf5_reader.h"
#include "io/schema.h"
#include "scene/option_values.h"

namespace pounding {
namespace {

constexpr const char* identity_name = "identity";
constexpr const char* sums_name = "members/crc32";

/// A dataset with a row per member.
struct Quantity {
  const char* name;
  const char* unit;
  std::vector<std::size_t> shape;  ///< of one member
  std::vector<double> MemberResult::*values;

  std::size_t size() const {
    std::size_t product = 1;
    for (const std::size_t extent : shape) product *= extent;
    return product;
  }
};

std::vector<Quantity> quantities(const EnsembleLayout& layout) {
  const std::size_t channels = layout.channels.size();
  const std::size_t contacts = layout.contacts.size();
  std::vector<Quantity> list{
      {"spectra/pseudo_acceleration",
       "m/s2",
       {channels, layout.damping_ratios.size(), layout.frequencies.size()},
       &MemberResult::spectra},
      {"peaks/displacement", "m", {channels}, &MemberResult::displacement},
      {"peaks/acceleration", "m/s2", {channels}, &MemberResult::acceleration},
      {"energy/residual", "-", {}, &MemberResult::energy_residual}};
  if (!layout.spans.empty()) {
    list.push_back({"spans/peak", "m, rad", {layout.spans.size(), 8}, &MemberResult::span_peak});
    list.push_back({"spans/time", "s", {layout.spans.size(), 8}, &MemberResult::span_time});
  }
  if (!layout.bases.empty()) {
    list.push_back({"bases/settled", "m", {layout.bases.size(), 3}, &MemberResult::settled});
  }
  if (!layout.forces.empty()) {
    list.push_back({"forces/history",
                    "N, N m",
                    {layout.force_times.size(), layout.forces.size()},
                    &MemberResult::forces});
  }
  if (contacts == 0) return list;
  const std::size_t pairs = layout.pair_contacts.size();
  if (const std::size_t windows = layout.struck.areas.size() + layout.struck.edges.size()) {
    list.push_back({"struck/largest", "N, s, m", {contacts, windows, 5}, &MemberResult::struck});
  }
  if (layout.friction) list.push_back({"impacts/slip", "m", {contacts}, &MemberResult::slip});
  list.insert(list.end(),
              {{"impacts/episodes", "-", {contacts}, &MemberResult::episodes},
               {"impacts/first_time", "s", {contacts}, &MemberResult::first_time},
               {"impacts/impulse_sum", "N s", {contacts}, &MemberResult::impulse_sum},
               {"impacts/impulse_largest", "N s", {contacts}, &MemberResult::impulse_largest},
               {"impacts/force_peak", "N", {contacts}, &MemberResult::force_peak},
               {"gaps/smallest", "m", {contacts}, &MemberResult::smallest_gap},
               {"pairs/initial_gap", "m", {pairs}, &MemberResult::pair_initial_gap},
               {"pairs/least_gap", "m", {pairs}, &MemberResult::pair_least_gap},
               {"pairs/time", "s", {pairs}, &MemberResult::pair_time},
               {"pairs/displacement", "m", {pairs, 3}, &MemberResult::pair_displacement},
               {"other_pass/depth", "m", {contacts}, &MemberResult::other_depth},
               {"other_pass/row", "-", {contacts}, &MemberResult::other_row},
               {"other_pass/time", "s", {contacts}, &MemberResult::other_time},
               {"contact/complementarity_residual", "-", {}, &MemberResult::contact_residual}});
  return list;
}

/// CRC-32 of the numbers of a member, quantity after quantity.
double sum_of(const std::vector<Quantity>& list, const MemberResult& result) {
  uLong sum = crc32(0, nullptr, 0);
  for (const Quantity& quantity : list) {
    const std::vector<double>& values = result.*quantity.values;
    sum = crc32(sum, reinterpret_cast<const Bytef*>(values.data()),
                static_cast<uInt>(values.size() * sizeof(double)));
  }
  return static_cast<double>(sum);
}

/// Numbers that say that nothing is there yet.
void fill(const OffsetFile& file, std::int64_t offset, std::size_t count, double value) {
  const std::vector<double> block(std::min<std::size_t>(count, 1 << 17), value);
  for (std::size_t done = 0; done < count; done += block.size()) {
    file.write(offset + static_cast<std::int64_t>(done * sizeof(double)),
               std::span(block).first(std::min(block.size(), count - done)));
  }
}

void create(const std::string& path, const EnsembleLayout& layout) {
  const std::size_t members = layout.table->members();
  const std::string draft = path + ".new";
  Hdf5File file(draft, Hdf5File::Kind::sealed);
  schema::write(file, schema::ensemble);
  std::vector<OpenBytes> open;
  const auto reserve = [&](const std::string& name, std::vector<std::size_t> shape) {
    std::size_t count = members;
    for (const std::size_t extent : shape) count *= extent;
    shape.insert(shape.begin(), members);
    open.push_back({file.reserve(name, shape), static_cast<std::int64_t>(count * sizeof(double))});
  };
  std::vector<double> numbers(members);
  std::iota(numbers.begin(), numbers.end(), 1.0);
  file.write_array("members/number", 0, numbers);
  file.write_texts("members/table", layout.table->columns, layout.table->values);
  file.write_array("spectra/damping", 0, layout.damping_ratios);
  file.write_array("spectra/frequency", 0, layout.frequencies);
  file.write_attribute("spectra/frequency", "unit", "Hz");
  std::string names;
  for (const Quantity& quantity : quantities(layout)) {
    reserve(quantity.name, quantity.shape);
    file.write_attribute(quantity.name, "unit", quantity.unit);
    names += (names.empty() ? "" : ",") + std::string(quantity.name);
  }
  reserve(sums_name, {});
  file.write_attribute(sums_name, "of", names);
  reserve("done", {});
  file.write_strings(identity_name, layout.identity);  // where there are groups for them
  file.write_strings("spectra/channels", layout.channels);
  if (!layout.spans.empty()) file.write_strings("spans/names", layout.spans);
  if (!layout.bases.empty()) file.write_strings("bases/names", layout.bases);
  if (!layout.forces.empty()) {
    file.write_strings("forces/names", layout.forces);
    file.write_array("forces/time", 0, layout.force_times);
    file.write_attribute("forces/time", "unit", "s");
  }
  if (!layout.contacts.empty()) {
    file.write_strings("impacts/contacts", layout.contacts);
    if (!layout.struck.areas.empty()) file.write_array("struck/areas", 0, layout.struck.areas);
    if (!layout.struck.edges.empty()) file.write_array("struck/edges", 0, layout.struck.edges);
    file.write_array("pairs/contact", 0, layout.pair_contacts);
    file.write_array("pairs/place", 3, layout.pair_places);
    file.write_attribute("pairs/place", "unit", "m");
  }
  file.let_others_write();
  const OffsetFile filled(draft, OffsetFile::Access::write);
  for (const OpenBytes& one : open) {
    const bool flags = one.first == open.back().first;
    fill(filled, one.first, static_cast<std::size_t>(one.bytes) / sizeof(double),
         flags ? 0 : std::numeric_limits<double>::quiet_NaN());
  }
  filled.sync();
  file.close(open);
  file.move_to(path);
}

void require_schema(const std::string& path, const Hdf5Reader& file) {
  try {
    schema::require(file, schema::ensemble);
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(path + ": an ensemble " + error.what());
  }
}

/// The first difference between two identities; empty if there is none.
std::string difference(const std::vector<std::string>& before,
                       const std::vector<std::string>& now) {
  for (std::size_t i = 0; i < std::max(before.size(), now.size()); ++i) {
    const std::string was = i < before.size() ? before[i] : "nothing";
    const std::string is = i < now.size() ? now[i] : "nothing";
    if (was != is) return "there: " + shown_value(was) + "; now: " + shown_value(is);
  }
  return "";
}

bool counts(const std::string& name) {
  return !may_differ(name, Comparison::ensemble) && !name.ends_with("_modal_basis");
}

bool names_content(const std::string& name) {
  return name.ends_with("_mesh") || name.ends_with("_record") || name.ends_with("_target") ||
         name.ends_with("_soil_table") || name.ends_with("_survey");
}

}  // namespace

void EnsembleFile::refuse_another(const std::string& path, const EnsembleLayout& layout) {
  const std::string remedy = "; give another -output, or remove that file to begin anew";
  require_no_link(path);
  if (!std::filesystem::exists(path)) return;
  std::string found;
  try {
    const Hdf5Reader file(path, Hdf5Reader::Kind::sealed);
    require_schema(path, file);
    std::vector<std::string> lines = file.strings(identity_name);
    lines.resize(std::min(lines.size(), layout.identity.size()));
    found = difference(lines, layout.identity);
  } catch (const std::runtime_error& error) {
    throw UserError(std::string(error.what()) + remedy);
  }
  refuse_if(!found.empty(), path + " holds another ensemble (" + found + ")" + remedy);
}

void EnsembleFile::prepare(const std::string& path, const EnsembleLayout& layout) {
  refuse_another(path, layout);
  if (!std::filesystem::exists(path)) create(path, layout);
}

EnsembleFile::EnsembleFile(const std::string& path, const EnsembleLayout& layout)
    : layout_(layout),
      reader_(path, OffsetFile::Access::read),
      writer_(path, OffsetFile::Access::write) {
  try {
    const Hdf5Reader file(path, Hdf5Reader::Kind::sealed);
    const auto offset_of = [&](const std::string& name, std::vector<std::size_t> shape) {
      shape.insert(shape.begin(), layout.table->members());
      if (file.extent(name) != shape) {
        throw std::runtime_error(path + ": dataset '" + name + "' has another shape");
      }
      return file.offset(name);
    };
    for (const Quantity& quantity : quantities(layout)) {
      offsets_.push_back(offset_of(quantity.name, quantity.shape));
    }
    sums_ = offset_of(sums_name, {});
    done_ = offset_of("done", {});
  } catch (const std::runtime_error& error) {
    throw UserError(std::string(error.what()) + "; remove that file to begin anew");
  }
}

std::vector<EnsembleFile::Member> EnsembleFile::members() const {
  const std::vector<Quantity> list = quantities(layout_);
  std::vector<double> flags(layout_.table->members());
  std::vector<double> sums(flags.size());
  reader_.read(done_, flags);
  reader_.read(sums_, sums);
  std::vector<Member> found(flags.size(), Member::missing);
  for (std::size_t m = 0; m < flags.size(); ++m) {
    if (flags[m] == 0) continue;
    found[m] = flags[m] == 1 && sum_of(list, read(m)) == sums[m] ? Member::done : Member::damaged;
  }
  return found;
}

std::vector<bool> EnsembleFile::done() const {
  std::vector<bool> done;
  for (const Member member : members()) done.push_back(member == Member::done);
  return done;
}

std::size_t EnsembleFile::damaged() const {
  return static_cast<std::size_t>(std::ranges::count(members(), Member::damaged));
}

void EnsembleFile::write(std::size_t member, const MemberResult& result) {
  const std::vector<Quantity> list = quantities(layout_);
  const auto at = [member](std::int64_t offset, std::size_t size) {
    return offset + static_cast<std::int64_t>(member * size * sizeof(double));
  };
  for (std::size_t q = 0; q < list.size(); ++q) {
    writer_.write(at(offsets_[q], list[q].size()), result.*list[q].values);
  }
  const double sum = sum_of(list, result);
  writer_.write(at(sums_, 1), {&sum, 1});
  writer_.sync();
  const double flag = 1;
  writer_.write(at(done_, 1), {&flag, 1});
  writer_.sync();
}

MemberResult EnsembleFile::read(std::size_t member) const {
  const std::vector<Quantity> list = quantities(layout_);
  MemberResult result;
  for (std::size_t q = 0; q < list.size(); ++q) {
    std::vector<double>& values = result.*list[q].values;
    values.resize(list[q].size());
    reader_.read(offsets_[q] + static_cast<std::int64_t>(member * values.size() * sizeof(double)),
                 values);
  }
  return result;
}

void write_ensemble_table(const std::string& path, const EnsembleLayout& layout,
                          const EnsembleFile& file, int digits) {
  const MemberTable& table = *layout.table;
  const std::vector<bool> done = file.done();
  std::vector<Quantity> list = quantities(layout);
  std::erase_if(list, [](const Quantity& quantity) {  // they have no place in a line
    constexpr std::array<std::string_view, 6> left{"spectra/", "pairs/",  "spans/",
                                                   "bases/",   "forces/", "struck/"};
    return std::ranges::any_of(
        left, [&](auto group) { return std::string_view(quantity.name).starts_with(group); });
  });
  std::string text = "member,done";
  for (const std::string& column : table.columns) text += "," + column;
  const auto name = [](std::string quantity) {
    std::ranges::replace(quantity, '/', '_');
    return quantity;
  };
  for (const Quantity& quantity : list) {
    const bool channels = std::string_view(quantity.name).starts_with("peaks/");
    const std::vector<std::string>& owners = channels ? layout.channels : layout.contacts;
    if (quantity.shape.empty()) text += "," + name(quantity.name);
    for (std::size_t i = 0; i < (quantity.shape.empty() ? 0 : quantity.size()); ++i) {
      text += "," + name(quantity.name) + " " + owners[i];
    }
  }
  text += "\n";
  for (std::size_t m = 0; m < table.members(); ++m) {
    text += std::to_string(m + 1) + (done[m] ? ",1" : ",0");
    for (std::size_t c = 0; c < table.columns.size(); ++c) {
      const std::string value = plain_cell(table.value(m, c));
      text += value.find(',') == std::string::npos ? "," + value : ",\"" + value + "\"";
    }
    const MemberResult result = done[m] ? file.read(m) : MemberResult{};
    for (const Quantity& quantity : list) {
      for (std::size_t i = 0; i < quantity.size(); ++i) {
        char number[40] = "";
        const double value =
            done[m] ? (result.*quantity.values)[i] : std::numeric_limits<double>::quiet_NaN();
        if (value == value) std::snprintf(number, sizeof number, "%.*g", digits, value);
        text += std::string(",") + number;
      }
    }
    text += "\n";
  }
  write_whole_file(path, text);
}

std::vector<std::string> ensemble_identity(const OptionValues& resolved, const MemberTable& table) {
  std::vector<std::string> lines;
  for (const auto& [name, value] : resolved) {
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

std::vector<std::string> identity_of_files(MPI_Comm comm, const OptionValues& resolved,
                                           const MemberTable& table,
                                           const std::vector<std::string>& opened) {
  std::set<std::string> files(opened.begin(), opened.end());
  const auto take_file = [&](const std::string& name, const std::string& value) {
    if (names_content(name) && !value.empty() && value != "none") files.insert(value);
  };
  for (const auto& [name, value] : resolved) {
    if (counts(name)) take_file(name, value);
  }
  for (std::size_t m = 0; m < table.members(); ++m) {
    for (std::size_t c = 0; c < table.columns.size(); ++c) {
      take_file(table.columns[c], table.value(m, c));
    }
  }
  std::vector<std::string> lines;
  on_rank0(comm, [&] {
    for (const std::string& file : files) {
      std::error_code failure;
      if (!std::filesystem::is_regular_file(file, failure)) continue;
      lines.push_back("file " + file + " " + digest_of_file(file).sha256);
    }
  });
  broadcast_values(comm, 0, lines);
  return lines;
}

}  // namespace pounding
