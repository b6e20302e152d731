#include "scene/modal_reader.h"

#include <algorithm>

#include "common/error.h"
#include "scene/damping_reader.h"

namespace pounding {
namespace {

using Names = OptionReader::Names;

constexpr std::string_view model = "<structure>_model";
constexpr std::string_view candidates = "<structure>_modal_candidates";
constexpr std::string_view cutoff = "<structure>_modal_cutoff";
constexpr std::string_view damping = "<structure>_modal_damping";
constexpr std::string_view basis = "<structure>_modal_basis";
constexpr std::string_view ranks = "<structure>_modal_ranks";
constexpr std::string_view switched_part = "<structure>_switched_part";

/// Refuses parts of a structure that couple its modes; of one that is switched, all that a step in
/// modes does not know.
void refuse_couplings(const OptionReader& options, const Structure& structure,
                      const std::string& kind) {
  const bool switched = kind == "switched";
  const std::string chosen = "-<structure>_model";
  const std::string remedy = "not in a structure with " + chosen + " " + kind +
                             "; leave it out, or give " + chosen + " full";
  for (const Region& region : structure.regions) {
    const Names names{structure.name, region.group};
    const LawTrait apart = switched ? any_law : is_full_order;
    if (const auto* law = apart.of(region)) options.forbid(law->option, names, remedy);
    options.refuse_if(switched && region.damping_factor != 1, region_damping_factor, names, remedy);
    if (is_nonlinear(region) && structure.uniform_damping) {
      options.forbid(is_nonlinear.of(region)->option, names,
                     "not with " + chosen +
                         " modal and -<structure>_damping_uniform, which would damp slack and "
                         "yielding elements; leave one of the three out");
    }
    if (region.damping) {
      options.forbid_each("<structure>_<group>_damping_", {"alpha", "beta", "ratio"}, names,
                          remedy);
    }
  }
  for (const char* option :
       {"p_delta", "mass_scaling", "time_step_target", "absorbing", "absorbing_base",
        "modal_damping", "modal_attachment", "modal_patches"}) {
    const std::string pattern = std::string("<structure>_") + option;
    if (switched && options.changed(pattern, {structure.name})) {
      options.forbid(pattern, {structure.name}, remedy);
    }
  }
}

}  // namespace

void read_model(OptionReader& options, Structure& structure) {
  const Names names{structure.name};
  const std::string kind = options.choice(model, names);
  if (kind == "full") {
    options.forbid(switched_part, names, goes_with(model, "switched"));
    options.forbid_all<ModalModel>(names, goes_with(model, "modal"));
    return;
  }
  refuse_couplings(options, structure, kind);
  ModalModel modal;
  modal.switched_part = kind == "switched" ? 1 : 0;
  modal.attachment = kind == "modal";
  options.read(modal, names);
  options.refuse_if(modal.candidates > 0 && modal.candidates < modal.modes, candidates, names,
                    "at least as many as -<structure>_modal_vectors " +
                        std::to_string(modal.modes) + ", which are chosen from them");
  refuse_if(kind == "modal" && modal.modes == 0 && modal.cutoff == 0,
            "option -" + structure.name + "_model modal: give -" + structure.name +
                "_modal_vectors (number of lowest modes) or -" + structure.name +
                "_modal_cutoff (every mode below it, in Hz)");
  if (options.given(damping, names)) {
    if (structure.uniform_damping) {
      options.forbid(damping, names, "not with -<structure>_damping_uniform");
    }
    const double factor = read_damping_factor(options, structure.name);
    for (double& ratio : modal.damping_ratios) {
      ratio *= factor;
      options.refuse_if(!option_row(damping).range.contains(ratio), damping, names,
                        "times -<structure>_damping_factor it is too large");
    }
  }
  options.refuse_if(modal.ranks > 1 && modal.basis_file.empty(), ranks, names,
                    "several ranks do not find the same bits twice: give a file that keeps the "
                    "basis (-<structure>_modal_basis)");
  if (kind == "modal") {
    structure.modal = std::move(modal);
    return;
  }
  if (modal.switched_part > 0) structure.switched = std::move(modal);
}

void check_switched(const OptionReader& options, const Scene& scene, bool ensemble) {
  for (const Structure& structure : scene.structures) {
    if (!structure.switched) continue;
    std::string apart;
    if (ensemble) apart = "-ensemble, whose members take their steps together";
    if (scene.certificate.window > 0 || scene.fidelity.target > 0) {
      apart = "-fidelity_window or _target, which judge a run of one order";
    }
    for (const Contact& contact : scene.contacts) {
      const bool hard = !contact.filler && !contact.is_elastic();
      if (!hard) apart = "contact " + contact.name + ", which has forces beside hard contact";
    }
    for (const Loop& loop : scene.loops) {
      if (loop.structure == structure.name) apart = "loop " + loop.name;
    }
    if (apart.empty()) continue;
    options.refuse(model, {structure.name}, "not with " + apart + "; give full");
  }
}

}  // namespace pounding
