#include "scene/modal_reader.h"

#include <algorithm>

#include "common/error.h"

namespace pounding {
namespace {

using Names = OptionReader::Names;

constexpr std::string_view model = "<structure>_model";
constexpr std::string_view vectors = "<structure>_modal_vectors";
constexpr std::string_view candidates = "<structure>_modal_candidates";
constexpr std::string_view cutoff = "<structure>_modal_cutoff";
constexpr std::string_view damping = "<structure>_modal_damping";
constexpr std::string_view basis = "<structure>_modal_basis";
constexpr std::string_view ranks = "<structure>_modal_ranks";

void refuse_couplings(const OptionReader& options, const Structure& structure) {
  for (const Region& region : structure.regions) {
    const Names names{structure.name, region.group};
    const std::string remedy = "not in a structure with -" + option_name(model, {structure.name}) +
                               " modal; leave it out, or give -" +
                               option_name(model, {structure.name}) + " full";
    if (const auto* law = is_full_order.of(region)) options.forbid(law->option, names, remedy);
    if (is_nonlinear(region) && structure.uniform_damping) {
      options.forbid(
          is_nonlinear.of(region)->option, names,
          "not with -" + option_name(model, {structure.name}) + " modal and -" + structure.name +
              "_damping_uniform, which would damp slack and yielding elements; leave one of "
              "the three out");
    }
    if (region.damping) {
      for (const char* option : {"alpha", "beta", "ratio"}) {
        options.forbid(std::string("<structure>_<group>_damping_") + option, names, remedy);
      }
    }
  }
}

}  // namespace

std::optional<ModalModel> read_modal_model(OptionReader& options, const Structure& structure) {
  const Names names{structure.name};
  if (options.choice(model, names) == "full") {
    options.forbid_all<ModalModel>(names, goes_with(model, names, "modal"));
    return std::nullopt;
  }
  refuse_couplings(options, structure);
  ModalModel modal;
  options.read(modal, names);
  if (modal.candidates > 0 && modal.candidates < modal.modes) {
    options.refuse(candidates, names,
                   "at least as many as -" + option_name(vectors, names) + " " +
                       std::to_string(modal.modes) + ", which are chosen from them");
  }
  if (modal.modes == 0 && modal.cutoff == 0) {
    throw UserError("option -" + option_name(model, names) + " modal: give -" +
                    option_name(vectors, names) + " (number of lowest modes) or -" +
                    option_name(cutoff, names) + " (every mode below it, in Hz)");
  }
  if (options.given(damping, names)) {
    if (structure.uniform_damping) {
      options.forbid(damping, names, "not with -" + structure.name + "_damping_uniform");
    }
    const double factor = read_damping_factor(options, structure.name);
    for (double& ratio : modal.damping_ratios) {
      ratio *= factor;
      if (!option_row(damping).range.contains(ratio)) {
        options.refuse(damping, names,
                       "times -" + structure.name + "_damping_factor it is too large");
      }
    }
  }
  if (modal.ranks > 1 && modal.basis_file.empty()) {
    options.refuse(
        ranks, names,
        "several ranks do not find the same bits twice: give a file that keeps the basis (-" +
            option_name(basis, names) + ")");
  }
  return modal;
}

}  // namespace pounding
