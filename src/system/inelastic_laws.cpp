#include "system/inelastic_laws.h"

#include <algorithm>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>

#include "common/error.h"
#include "common/parallel.h"
#include "elements/force_rows.h"
#include "elements/local_frame.h"
#include "laws/cracking_shell.h"
#include "scene/law_kinds.h"
#include "system/each_element.h"
#include "system/motion_laws.h"

namespace pounding {
namespace {

using interactions::HystereticLaw;
using Law = std::shared_ptr<interactions::ElementLaw>;

constexpr std::size_t beam_size = 12;
constexpr std::size_t of_node = 6;  ///< components

/// `part` of a beam between two nodes.
LawMotion motion_of(const OwnLaw& part, const Segment& segment, const Matrix3& frame,
                    const ElementProperties& p) {
  const double h = segment.length;
  Vector3 along{}, about{};  // of the sway, and of rotations
  const std::size_t turns = part.shear ? 3 - part.axis : part.axis;
  for (std::size_t d = 0; d < 3; ++d) {
    along[d] = frame[part.axis][d];
    about[d] = frame[turns][d];
  }
  const double rigidity = p.young * (turns == 1 ? p.inertia_y : p.inertia_z);
  std::vector<double> shape(beam_size, 0.0);
  for (std::size_t node = 0; node < 2; ++node) {
    const double sign = node == 0 ? -1 : 1;
    // A sway along y turns by +r_z, one along z by -r_y.
    const double turn = part.shear ? (turns == 2 ? -h / 2 : h / 2) : sign;
    for (std::size_t d = 0; d < 3; ++d) {
      if (part.shear) shape[node * of_node + d] = sign * along[d];
      shape[node * of_node + 3 + d] = turn * about[d];
    }
  }
  Hysteresis own = scaled(part.law, h, 1);
  if (part.shear) own = in_series(own, 12 * rigidity / (h * h * h));
  return {std::move(shape), std::make_shared<const HystereticLaw>(own), 1, !part.shear};
}

/// Throws std::domain_error where the element cannot follow them.
std::vector<LawMotion> motions_of(std::span<const OwnLaw> parts,
                                  std::span<const double> coordinates,
                                  const ElementProperties& properties) {
  const Segment segment = segment_between(coordinates);
  const Matrix3 frame = local_frame(segment.direction, properties.z_axis);
  std::vector<LawMotion> found;
  for (const OwnLaw& part : parts) found.push_back(motion_of(part, segment, frame, properties));
  return found;
}

/// Axial force that weakens the bending of a beam; nothing where it does not.
std::optional<AxialWeakening> axial_of(const YieldingSection& section,
                                       std::span<const double> coordinates,
                                       const ElementProperties& properties) {
  if (section.axial_strength == 0) return std::nullopt;
  const Segment segment = segment_between(coordinates);
  std::vector<double> shape(beam_size, 0.0);
  for (std::size_t d = 0; d < 3; ++d) {
    shape[of_node + d] = properties.young * properties.area / segment.length * segment.direction[d];
    shape[d] = -shape[of_node + d];
  }
  return AxialWeakening{std::move(shape), section.axial_strength, section.axial_exponent};
}

/// Calls `add(type, coordinates, properties)` with every element of a region. Throws UserError
/// where the law of one cannot be.
template <typename Add>
void for_each_of_region(const Structure& structure, const Mesh& mesh, int region, Add&& add) {
  const ElementProperties properties = element_properties(structure.regions[region]);
  stiffness::ElementWork coordinates;
  for_each_element_of(
      structure, mesh, region,
      [&](const ElementBlock& block, std::size_t e, const ElementLayout&,
          const stiffness::ElementWork&) {
        try {
          add(block.type, gather_coordinates(mesh, block, e, coordinates), properties);
        } catch (const std::domain_error& error) {
          throw UserError("structure " + structure.name + ": " + describe_element(mesh, block, e) +
                          ": " + error.what() +
                          "; give shorter elements, or a skeleton that falls less steeply");
        }
      });
}

/// Law of the beams of a region whose sections yield. In each of its planes a beam of length h has
/// two motions that its stiffness does not couple, the relative rotation r of its ends, at one
/// curvature, and the sway w of one end beside the other less their mean rotation,
///
///     r = r_2 - r_1,                          M = E I / h r
///     w = w_2 - w_1 - h (r_1 + r_2) / 2,      Q = w / (h / (G A) + h^3 / (12 E I))
///
/// M over r / h follows the law of the section in bending, and Q over the part of w / h that is
/// shear its law in shear, in series with the bending of that motion, which stays elastic. All else
/// is K u. With an axial strength the laws in bending follow 1 - (|N| / N_y)^a of theirs, N the
/// axial force E A / h times the axial elongation. Throws UserError where an element is too long
/// for a skeleton that falls. Local.
Law yielding_beams(const Structure& structure, const Mesh& mesh, int region) {
  const YieldingSection& section = structure.regions[region].yielding;
  const std::vector<OwnLaw> parts = own_laws(structure.regions[region]);
  auto beams = std::make_shared<MotionLaws>(parts, false);
  for_each_of_region(structure, mesh, region, [&](ElementType, const auto& x, const auto& own) {
    beams->add(motions_of(parts, x, own), axial_of(section, x, own));
  });
  return beams;
}

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
    return {own.area * (work / 2 - law_.stored(memory)), true, true};
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

/// Law of the shells of a region that crack. Their mean membrane strains and curvatures e, those at
/// the centre, follow a CrackingShell with forces N(e) per length in place of those of K,
///
///     g = A B^T (N(B u) - D0 B u),        W_n = A (1/2 N . e - S)
///
/// A the area and S the energy that the law holds per area. K less A B^T D0 B is positive or zero,
/// since the energy of mean strains is at most that of all, and the modes of shell4 have no mean.
/// Axes are those of the shell's forces (shell_force_axes). Throws UserError for an element that
/// cannot be. Local.
Law cracking_shells(const Structure& structure, const Mesh& mesh, int region) {
  const Region& own = structure.regions[region];
  const ShellCracking law =
      CrackingShell::with_slopes(*own.yielding_shell.cracking, own.material.poisson);
  refuse_if(!(law.tension < 1),

            "option -" + structure.name + "_" + own.group +
                "_cracked_tension: more than is left beside its cracked_compression; give less, "
                "or more of that");
  const CrackingShell shell(own.material.young, own.material.poisson, own.thickness, law);
  auto shells = std::make_shared<CrackingShells>(shell, own.thickness);
  for_each_of_region(structure, mesh, region,
                     [&](ElementType type, const auto& x, const auto& properties) {
                       shells->add(shell_strain_rows(type, x, properties), shell_area(type, x));
                     });
  return shells;
}

/// The mean shear strain of a shell, under a law of stress over strain.
LawMotion shear_motion(ElementType type, std::span<const double> coordinates,
                       const ElementProperties& properties,
                       std::shared_ptr<const HystereticLaw> law) {
  constexpr std::size_t g12 = 2;
  const double volume = shell_area(type, coordinates) * properties.thickness;
  const std::vector<double> strains = shell_strain_rows(type, coordinates, properties);
  const auto size = static_cast<std::ptrdiff_t>(element_layout(type).size());
  const auto begin = strains.begin() + g12 * size;
  return {std::vector<double>(begin, begin + size), std::move(law), volume};
}

/// Law of the shells of a region that yield in shear in their plane. The shear strain at the centre
/// is its mean over the element, whatever the shape, and the modes of shell4 have none of it, so
///
///     G V g^2 / 2,      g = mean of g12, V the volume
///
/// is a part of the membrane's energy beside which the rest is positive or zero. The stress over g
/// follows the law, all else is K u: the other strains, the shear that varies within the element,
/// bending, drilling. 1 and 2 are the axes of the shell's forces (shell_force_axes). Throws
/// UserError for an element that cannot be. Local.
Law yielding_shells(const Structure& structure, const Mesh& mesh, int region) {
  const std::vector<OwnLaw> laws = own_laws(structure.regions[region]);
  auto shells = std::make_shared<MotionLaws>(laws, false);
  const auto shear = std::make_shared<const HystereticLaw>(laws.front().law);
  for_each_of_region(structure, mesh, region,
                     [&](ElementType type, const auto& x, const auto& properties) {
                       shells->add({shear_motion(type, x, properties, shear)});
                     });
  return shells;
}

/// Law of the springs or bars of a region that yield, each component by its own,
///
///     g = b N(b . u),      b . u the elongation or relative rotation along or about its axis
///
/// All of N where K does not hold them, N less its first line beside the modes of a reduced
/// structure. No damping of K acts on it. Throws UserError for an element that cannot be.
/// Local.
Law yielding_springs(const Structure& structure, const Mesh& mesh, int number) {
  const bool bar = is_bar(structure.regions[number].element);
  const std::vector<OwnLaw> laws = own_laws(structure.regions[number]);
  auto springs = std::make_shared<MotionLaws>(laws, !structure.modal);
  stiffness::ElementWork coordinates;
  for (const ElementBlock& block : mesh.blocks) {
    const ElementLayout layout = element_layout(block.type);
    for (std::size_t e = 0; block.region == number && e < block.count(); ++e) {
      Segment segment;
      if (bar) segment = segment_between(gather_coordinates(mesh, block, e, coordinates));
      std::vector<LawMotion> motions;
      for (const OwnLaw& own : laws) {
        std::vector<double> shape(layout.size(), 0.0);
        for (int node = 0; node < layout.nodes; ++node) {
          double* const to = &shape[node * layout.components];
          const double sign = node + 1 == layout.nodes ? 1 : -1;
          if (!bar) to[own.axis] = sign;
          for (std::size_t d = 0; bar && d < 3; ++d) to[d] = sign * segment.direction[d];
        }
        const Hysteresis law = scaled(own.law, bar ? segment.length : 1, 1);
        motions.push_back({std::move(shape), std::make_shared<const HystereticLaw>(law)});
      }
      springs->add(std::move(motions));
    }
  }
  return springs;
}

Law law_of_region(const Structure& structure, const Mesh& mesh, int region) {
  const Region& own = structure.regions[region];
  if (is_spring(own.element) || is_bar(own.element)) {
    return yielding_springs(structure, mesh, region);
  }
  if (!is_shell(own.element)) return yielding_beams(structure, mesh, region);
  return own.yielding_shell.cracking ? cracking_shells(structure, mesh, region)
                                     : yielding_shells(structure, mesh, region);
}

}  // namespace

Hysteresis in_series(const Hysteresis& law, double elastic) {
  Hysteresis result = law;
  result.flexibility = 1 / elastic;
  for (Skeleton* skeleton : {&result.positive, &result.negative}) {
    double before = 0;
    for (SkeletonBreak& corner : skeleton->breaks) {
      corner.elongation += corner.force / elastic;
      if (!(corner.elongation > before)) {
        throw std::domain_error("its skeleton falls faster than the element can unbend");
      }
      before = corner.elongation;
    }
    skeleton->last_slope /= 1 + skeleton->last_slope / elastic;
  }
  return result;
}

std::vector<interactions::RegionLaw> inelastic_laws(const Structure& structure, const Mesh& mesh) {
  std::vector<interactions::RegionLaw> laws;
  for (std::size_t r = 0; r < structure.regions.size(); ++r) {
    if (!has_element_law(structure.regions[r])) continue;
    const bool apart = structure.modal || follows_law(structure.regions[r]);
    const auto region = static_cast<int>(r);
    on_every_rank(mesh.comm, [&] {
      laws.push_back({region, law_of_region(structure, mesh, region), apart});
    });
  }
  return laws;
}

}  // namespace pounding
