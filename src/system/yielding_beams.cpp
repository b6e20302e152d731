#include "system/yielding_beams.h"

#include <array>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>

#include "common/error.h"
#include "elements/beam2.h"
#include "elements/local_frame.h"
#include "system/each_element.h"
#include "system/motion_laws.h"

namespace pounding {
namespace {

using interactions::HystereticLaw;

constexpr std::size_t beam_size = 12;
constexpr std::size_t of_node = 6;  ///< components

using Part = YieldingSection::Law;

/// `part` of a beam between two nodes.
SectionMotion motion_of(const Part& part, const Segment& segment, const Matrix3& frame,
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
  const Hysteresis own = scaled(*part.law, h, 1);
  if (!part.shear) return {std::move(shape), rigidity / h, own};
  const double bends = 12 * rigidity / (h * h * h);
  const ShearFlexibility phi = shear_flexibility(p, h);
  return {std::move(shape), bends / (1 + (part.axis == 1 ? phi.y : phi.z)), in_series(own, bends)};
}

/// Throws std::domain_error where the element cannot follow them.
std::vector<SectionMotion> motions_of(std::span<const Part> parts,
                                      std::span<const double> coordinates,
                                      const ElementProperties& properties) {
  const Segment segment = segment_between(coordinates);
  const Matrix3 frame = local_frame(segment.direction, properties.z_axis);
  std::vector<SectionMotion> found;
  for (const Part& part : parts) found.push_back(motion_of(part, segment, frame, properties));
  return found;
}

std::vector<LawMotion> with_memories(std::vector<SectionMotion> sections,
                                     std::span<const Part> parts) {
  std::vector<LawMotion> found;
  for (std::size_t m = 0; m < sections.size(); ++m) {
    found.push_back({std::move(sections[m].shape),
                     std::make_shared<const HystereticLaw>(sections[m].law), 1, !parts[m].shear});
  }
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

}  // namespace

Hysteresis in_series(const Hysteresis& law, double elastic) {
  Hysteresis result = law;
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

std::vector<SectionMotion> section_motions(const Region& region, const Vector3& first,
                                           const Vector3& second) {
  const std::array<double, 6> ends{first[0], first[1], first[2], second[0], second[1], second[2]};
  return motions_of(region.yielding.laws(), ends, element_properties(region));
}

std::shared_ptr<interactions::ElementLaw> yielding_beams(const Structure& structure,
                                                         const Mesh& mesh, int region) {
  const Region& own = structure.regions[static_cast<std::size_t>(region)];
  const std::vector<Part> parts = own.yielding.laws();
  std::vector<const Hysteresis*> laws;
  for (const Part& part : parts) laws.push_back(part.law);
  auto beams = std::make_shared<MotionLaws>(own.yielding.names(), laws);
  const ElementProperties properties = element_properties(own);
  stiffness::ElementWork coordinates;
  for_each_element_of(
      structure, mesh, region,
      [&](const ElementBlock& block, std::size_t e, const ElementLayout&,
          const stiffness::ElementWork&) {
        try {
          const auto x = gather_coordinates(mesh, block, e, coordinates);
          beams->add(with_memories(motions_of(parts, x, properties), parts),
                     axial_of(own.yielding, x, properties));
        } catch (const std::domain_error& error) {
          throw UserError("structure " + structure.name + ": " + describe_element(mesh, block, e) +
                          ": " + error.what() +
                          "; give shorter elements, or a skeleton that falls less steeply");
        }
      });
  return beams;
}

}  // namespace pounding
