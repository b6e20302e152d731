#include "system/law_forces.h"

#include <algorithm>
#include <optional>

#include "system/element_forces.h"
#include "system/trace.h"

namespace pounding {
namespace {

/// Calls `visit(law, number of the element in its law, dofs)` with every element of this rank that
/// follows a law, one apart or not.
template <typename Visit>
void for_each_law_element(const std::vector<interactions::RegionLaw>& laws, bool apart,
                          const Mesh& mesh, Visit&& visit) {
  for (const auto& [region, law, is_apart] : laws) {
    if (is_apart != apart) continue;
    std::size_t element = 0;
    for (const ElementBlock& block : mesh.blocks) {
      if (block.region != region) continue;
      for (std::size_t e = 0; e < block.count(); ++e, ++element) {
        visit(*law, element, stiffness::ElementDofs(mesh, block, e));
      }
    }
  }
}

}  // namespace

std::vector<char> dofs_of_laws(const std::vector<interactions::RegionLaw>& laws, bool apart,
                               const Mesh& mesh) {
  if (std::ranges::find(laws, apart, &interactions::RegionLaw::apart) == laws.end()) return {};
  std::vector<char> acted_on(mesh.owned_dofs, 0);
  for_each_law_element(laws, apart, mesh,
                       [&](const interactions::ElementLaw& law, std::size_t element,
                           std::span<const LocalIndex> dofs) {
                         for (std::size_t i = 0; i < dofs.size(); ++i) {
                           const bool owned = dofs[i] >= 0 && dofs[i] < mesh.owned_dofs;
                           if (owned && law.acts_on(element, i)) acted_on[dofs[i]] = 1;
                         }
                       });
  return acted_on;
}

bool add_law_forces(const LinearSystem& system, bool apart, const Mesh& mesh,
                    const std::vector<double>& displacement, std::span<double> force) {
  if (!system.has_laws(apart)) return false;
  const std::vector<char> acted_on = dofs_of_laws(system.laws, apart, mesh);
  std::optional<Trace> trace;  // of a body in generalised coordinates, and its places
  std::vector<LocalIndex> places;
  std::vector<double> all;
  if (system.generalised) {
    for (std::size_t dof = 0; dof < acted_on.size(); ++dof) {
      if (acted_on[dof] != 0) places.push_back(static_cast<LocalIndex>(dof));
    }
    trace.emplace(system, mesh, points_of(mesh, places), false);
    std::vector<double> values(places.size());
    trace->apply(displacement.data(), values.data(), 1);
    all.assign(mesh.dof_count, 0.0);
    for (std::size_t k = 0; k < places.size(); ++k) all[places[k]] = values[k];
  } else {
    all = with_ghosts(mesh, displacement);
  }
  bool yields = false;
  std::vector<double> g_of(trace ? mesh.owned_dofs : 0, 0.0);
  const std::span<double> sum = trace ? std::span(g_of) : force;
  for_each_law_element(
      system.laws, apart, mesh,
      [&](const interactions::ElementLaw& law, std::size_t element,
          std::span<const LocalIndex> dofs) {
        std::array<double, max_element_size> u{}, g{};
        for (std::size_t i = 0; i < dofs.size(); ++i) u[i] = dofs[i] < 0 ? 0 : all[dofs[i]];
        std::vector<double> memory(law.memory_size(), 0.0);
        yields |=
            law.respond(element, {u.data(), dofs.size()}, memory, {g.data(), dofs.size()}).yields;
        for (std::size_t i = 0; i < dofs.size(); ++i) {
          if (dofs[i] >= 0 && dofs[i] < mesh.owned_dofs) sum[dofs[i]] += g[i];
        }
      });
  for (std::size_t k = 0; k < places.size(); ++k) trace->add_force(k, g_of[places[k]], force);
  return yields;
}

void add_law_stiffness(const LinearSystem& system, const Mesh& mesh, double sign, Mat matrix) {
  const std::vector<PetscInt> numbers = stiffness::global_numbers(mesh);
  for_each_law_element(system.laws, true, mesh,
                       [&](const interactions::ElementLaw& law, std::size_t element,
                           std::span<const LocalIndex> dofs) {
                         std::vector<double> tangent(dofs.size() * dofs.size(), 0.0);
                         law.add_tangent(element, sign, tangent);
                         stiffness::add_element(mesh, numbers, dofs, tangent.data(), matrix);
                       });
}

}  // namespace pounding
