#include "system/cracking_shells.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "elements/shell_forces.h"
#include "interactions/laws/cracking_shell.h"
#include "system/each_element.h"

namespace pounding {
namespace {

using interactions::CrackingLaw;
using interactions::CrackingShell;
using interactions::ShellVector;

constexpr std::size_t of_shear = 2;  ///< of a ShellVector

class CrackingShells final : public interactions::ElementLaw {
 public:
  CrackingShells(const CrackingShell& shell, double thickness)
      : law_(shell), thickness_(thickness) {}

  void add(std::vector<double> strains, double area) {
    elements_.push_back({std::move(strains), area});
  }

  std::size_t memory_size() const override { return CrackingLaw::memory_size(); }

  Response respond(std::size_t element, std::span<const double> displacement,
                   std::span<double> memory, std::span<double> force) const override {
    const Element& own = elements_[element];
    const std::size_t size = displacement.size();
    ShellVector strains{};
    for (std::size_t c = 0; c < strains.size(); ++c) {
      const double* const row = &own.strains[c * size];
      for (std::size_t i = 0; i < size; ++i) strains[c] += row[i] * displacement[i];
    }
    law_.advance(strains, memory);
    if (law_.is_sound(memory)) return {};
    const ShellVector sound = law_.shell().sound_forces(strains);
    const ShellVector acting = law_.forces(memory);
    double work = 0;
    for (std::size_t c = 0; c < strains.size(); ++c) {
      work += acting[c] * strains[c];
      const double less = own.area * (acting[c] - sound[c]);
      for (std::size_t i = 0; i < size; ++i) force[i] += less * own.strains[c * size + i];
    }
    return {own.area * (work / 2 - law_.stored(memory)), true};
  }

  std::vector<std::string> parts() const override { return {"cracking"}; }

  interactions::PartState part(std::size_t element, std::size_t /*number*/,
                               std::span<const double> memory) const override {
    const double area = elements_[element].area;
    const double lost = area * law_.lost(memory);
    const auto [lower, upper] = law_.damage(memory);
    const double worse = std::max(lower, upper);
    return {law_.strains(memory)[of_shear],
            law_.forces(memory)[of_shear] / thickness_,
            law_.loading(memory),
            lost,
            lost + area * law_.stored(memory),
            worse / (1 + worse)};
  }

 private:
  struct Element {
    std::vector<double> strains;  ///< B, shape (6, dofs)
    double area = 0;              ///< [m2]
  };

  CrackingLaw law_;
  double thickness_;
  std::vector<Element> elements_;
};

}  // namespace

std::shared_ptr<interactions::ElementLaw> cracking_shells(const Structure& structure,
                                                          const Mesh& mesh, int region) {
  const Region& own = structure.regions[static_cast<std::size_t>(region)];
  auto shells =
      std::make_shared<CrackingShells>(CrackingShell(own.material.young, own.material.poisson,
                                                     own.thickness, *own.yielding_shell.cracking),
                                       own.thickness);
  const ElementProperties properties = element_properties(own);
  stiffness::ElementWork coordinates;
  for_each_element_of(structure, mesh, region,
                      [&](const ElementBlock& block, std::size_t e, const ElementLayout&,
                          const stiffness::ElementWork&) {
                        const auto x = gather_coordinates(mesh, block, e, coordinates);
                        shells->add(shell_strain_rows(block.type, x, properties),
                                    shell_area(block.type, x));
                      });
  return shells;
}

}  // namespace pounding
