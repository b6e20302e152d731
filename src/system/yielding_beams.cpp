#include "system/yielding_beams.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <string>

#include "common/error.h"
#include "common/parallel.h"
#include "elements/beam2.h"
#include "elements/local_frame.h"
#include "interactions/laws/hysteretic_law.h"
#include "system/axial_forces.h"
#include "system/each_element.h"

namespace pounding {
namespace {

using interactions::HystereticLaw;

constexpr std::size_t beam_size = 12;
constexpr std::size_t of_node = 6;  ///< components

/// A law of a section, and the plane in which it acts.
struct Part {
  std::string name;
  const Hysteresis* law = nullptr;
  bool shear = false;
  std::size_t axis = 0;  ///< 1: local y, 2: local z, along which or about which it acts
};

std::vector<Part> parts_of(const YieldingSection& section) {
  std::vector<Part> parts;
  for (std::size_t axis = 1; axis < 3; ++axis) {
    const std::string name(1, "xyz"[axis]);
    if (const auto& law = section.shear[axis - 1]) {
      parts.push_back({"shear_" + name, &*law, true, axis});
    }
    if (const auto& law = section.bending[axis - 1]) {
      parts.push_back({"bending_" + name, &*law, false, axis});
    }
  }
  return parts;
}

/// A motion of the nodes of a beam, and the law that it follows.
struct Motion {
  std::array<double, beam_size> shape{};  ///< its elongation is shape . u [m, rad]
  double stiffness = 0;                   ///< of K [N/m, N m]
  HystereticLaw law;

  double elongation(std::span<const double> u) const {
    double sum = 0;
    for (std::size_t i = 0; i < beam_size; ++i) sum += shape[i] * u[i];
    return sum;
  }
};

/// `part` of a beam between two nodes.
Motion motion_of(const Part& part, const Segment& segment, const Matrix3& frame,
                 const ElementProperties& p) {
  const double h = segment.length;
  Vector3 along{}, about{};  // of the sway, and of rotations
  const std::size_t turns = part.shear ? 3 - part.axis : part.axis;
  for (std::size_t d = 0; d < 3; ++d) {
    along[d] = frame[part.axis][d];
    about[d] = frame[turns][d];
  }
  const double rigidity = p.young * (turns == 1 ? p.inertia_y : p.inertia_z);
  std::array<double, beam_size> shape{};
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
  if (!part.shear) return {shape, rigidity / h, HystereticLaw(own)};
  const double bends = 12 * rigidity / (h * h * h);
  const ShearFlexibility phi = shear_flexibility(p, h);
  return {shape, bends / (1 + (part.axis == 1 ? phi.y : phi.z)),
          HystereticLaw(in_series(own, bends))};
}

class YieldingBeams final : public interactions::ElementLaw {
 public:
  explicit YieldingBeams(const YieldingSection& section) : parts_(parts_of(section)) {
    for (const Part& part : parts_) {
      names_.push_back(part.name);
      begin_.push_back(begin_.back() + HystereticLaw(*part.law).memory_size());
    }
  }

  /// Adds an element, whose K is `stiffness`. Throws std::domain_error.
  void add(std::span<const double> coordinates, const ElementProperties& properties,
           std::span<const double> stiffness) {
    const Segment segment = segment_between(coordinates);
    const Matrix3 frame = local_frame(segment.direction, properties.z_axis);
    for (const Part& part : parts_) {
      motions_.push_back(motion_of(part, segment, frame, properties));
    }
    stiffness_.insert(stiffness_.end(), stiffness.begin(), stiffness.end());
  }

  std::size_t memory_size() const override { return begin_.back(); }

  double respond(std::size_t element, std::span<const double> displacement,
                 std::span<double> memory, std::span<double> force) const override {
    const double* const k = &stiffness_[element * beam_size * beam_size];
    for (std::size_t i = 0; i < beam_size; ++i) {
      force[i] = 0;
      for (std::size_t j = 0; j < beam_size; ++j) {
        force[i] += k[i * beam_size + j] * displacement[j];
      }
    }
    double lost = 0;
    for (std::size_t m = 0; m < parts_.size(); ++m) {
      const Motion& motion = motions_[element * parts_.size() + m];
      const std::span<double> own = memory.subspan(begin_[m], begin_[m + 1] - begin_[m]);
      const double elongation = motion.elongation(displacement);
      motion.law.advance(elongation, own);
      const double less = motion.law.force(own) - motion.stiffness * elongation;
      for (std::size_t i = 0; i < beam_size; ++i) force[i] += less * motion.shape[i];
      lost += motion.law.force(own) * elongation / 2 - motion.law.stored(own);
    }
    return lost;
  }

  std::vector<std::string> parts() const override { return names_; }

  interactions::PartState part(std::size_t element, std::size_t number,
                               std::span<const double> memory) const override {
    const HystereticLaw& law = motions_[element * parts_.size() + number].law;
    const auto own = memory.subspan(begin_[number], begin_[number + 1] - begin_[number]);
    return {law.elongation(own), law.force(own), law.ductility(own), law.lost(own),
            law.lost(own) + law.stored(own)};
  }

 private:
  std::vector<Part> parts_;
  std::vector<std::string> names_;
  std::vector<Motion> motions_;        ///< shape (elements, parts)
  std::vector<double> stiffness_;      ///< shape (elements, 12, 12)
  std::vector<std::size_t> begin_{0};  ///< of each part in a memory, and the end
};

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

std::vector<interactions::RegionLaw> yielding_beams(const Structure& structure, const Mesh& mesh) {
  std::vector<interactions::RegionLaw> laws;
  for (std::size_t r = 0; r < structure.regions.size(); ++r) {
    const Region& region = structure.regions[r];
    if (!region.yielding.any()) continue;
    auto beams = std::make_shared<YieldingBeams>(region.yielding);
    on_every_rank(mesh.comm, [&] {
      const ElementProperties properties = element_properties(region);
      stiffness::ElementWork coordinates;
      for_each_element(
          structure, mesh,
          [&](const ElementBlock& block, std::size_t) {
            return block.region == static_cast<int>(r);
          },
          [&](const ElementBlock& block, std::size_t e, const ElementLayout&,
              const stiffness::ElementWork& work) {
            try {
              beams->add(gather_coordinates(mesh, block, e, coordinates), properties,
                         {work.stiffness.data(), beam_size * beam_size});
            } catch (const std::domain_error& error) {
              throw UserError("structure " + structure.name + ": " +
                              describe_element(mesh, block, e) + ": " + error.what() +
                              "; give shorter elements, or a skeleton that falls less steeply");
            }
          });
    });
    laws.push_back({static_cast<int>(r), std::move(beams)});
  }
  return laws;
}

void require_elastic_rest(const std::vector<interactions::RegionLaw>& laws, const Mesh& mesh,
                          const std::vector<double>& displacement) {
  if (laws.empty()) return;
  const std::vector<double> all = with_ghosts(mesh, displacement);
  on_every_rank(mesh.comm, [&] {
    for (const auto& [region, law] : laws) {
      for (const ElementBlock& block : mesh.blocks) {
        if (block.region != region) continue;
        const ElementLayout layout = element_layout(block.type);
        for (std::size_t e = 0; e < block.count(); ++e) {
          std::array<double, max_element_size> u{}, f{};
          const auto dofs = stiffness::element_dofs(mesh, block, e, layout);
          const std::size_t size = layout.size();
          for (std::size_t i = 0; i < size; ++i) u[i] = dofs[i] < 0 ? 0 : all[dofs[i]];
          std::vector<double> memory(law->memory_size(), 0.0);
          law->respond(e, {u.data(), size}, memory, {f.data(), size});
          for (std::size_t p = 0; p < law->parts().size(); ++p) {
            const double ductility = law->part(e, p, memory).ductility;
            if (ductility <= 1) continue;
            std::ostringstream text;
            text << "option -preload static: " << describe_element(mesh, block, e)
                 << " of structure " << mesh.structure << " is at rest " << ductility
                 << " times beyond the first corner of its " << law->parts()[p]
                 << "; give a stronger skeleton, or leave -preload out";
            throw UserError(text.str());
          }
        }
      }
    }
  });
}

}  // namespace pounding
