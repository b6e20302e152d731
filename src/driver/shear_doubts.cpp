#include "driver/shear_doubts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <sstream>

#include "common/place_text.h"
#include "driver/beam_members.h"

namespace pounding {
namespace {

constexpr double doubted = 0.05;  ///< flexibility by shear over that by bending

/// Part of a section without shear areas that bears shear: that of a rectangle, more than flanged
/// and hollow sections have: there the doubt says less than the effect.
constexpr double shear_part = 5.0 / 6;

/// Shear flexibility of a member that its beams leave out over its flexibility by bending, in one
/// plane.
struct ShearShare {
  double share = 0;
  const Region* region = nullptr;  ///< where most of the shear is
  double length = 0;               ///< [m]
  Vector3 from{0, 0, 0};           ///< ends [m]
  Vector3 to{0, 0, 0};
  bool cantilever = false;
};

/// The beams `first` to `last` - 1 of a chain, bent about an axis by a force across one end.
class Member {
 public:
  Member(const GlobalMesh& mesh, const BeamChains& chains, const BeamChain& chain,
         const Vector3& axis, std::size_t first, std::size_t last)
      : mesh_(mesh), chains_(chains), chain_(chain), axis_(axis), first_(first), last_(last) {}

  /// Empty share where nothing bends that shear could add to.
  ShearShare share() const {
    const std::array<GlobalIndex, 2> ends{chain_.nodes[first_], chain_.nodes[last_]};
    const Vector3 across = cross(axis_, chains_.beam(chain_.beams[first_]).axes[0]);
    std::array<double, 2> yielding{};  // 1 / stiffness against turning
    std::array<bool, 2> is_free{};
    std::array<bool, 2> is_held{};
    for (std::size_t i = 0; i < 2; ++i) {
      yielding[i] = 1 / chains_.turning_stiffness(ends[i], chain_, axis_);
      is_free[i] = chains_.is_free_end(ends[i], chain_);
      is_held[i] = chains_.is_clamped_along(ends[i], across);
    }
    const std::array<bool, 2> hinged{std::isinf(yielding[0]), std::isinf(yielding[1])};
    if (hinged[0] && hinged[1]) {
      if (!is_held[0] || !is_held[1]) return {};
      yielding = {0, 0};  // under a force in the middle it is as flexible by halves
    } else if ((hinged[0] && !is_free[0] && !is_held[0]) ||
               (hinged[1] && !is_free[1] && !is_held[1])) {
      return {};  // carried by something that is no beam
    }
    if (is_held[0] && is_held[1] && last_ - first_ == 1 && !hinged[0] && !hinged[1]) return {};
    const bool cantilever = is_free[0] || is_free[1];
    if (!cantilever && length() < depth()) return {};  // a stub
    ShearShare found = shear();
    found.share = cantilever ? cantilever_share(is_free[0], yielding[is_free[0] ? 1 : 0])
                             : found.share / bending(yielding);
    found.cantilever = cantilever;
    found.length = length();
    found.from = mesh_.position(ends[0]);
    found.to = mesh_.position(ends[1]);
    return found;
  }

 private:
  const BeamPiece& beam(std::size_t i) const { return chains_.beam(chain_.beams[i]); }

  double length() const {
    double sum = 0;
    for (std::size_t i = first_; i < last_; ++i) sum += beam(i).length;
    return sum;
  }

  /// Depth of the rectangle that bends as the section does [m].
  double depth() const {
    const Region& region = *beam(first_).region;
    return std::sqrt(12 * beam(first_).bending(axis_) /
                     (region.material.young * region.section->area));
  }

  /// 1 / (kappa G A), or 0 where a beam is flexible in shear by itself [1/N].
  static double left_out(const BeamPiece& piece) {
    return is_flexible_in_shear(*piece.region) ? 0 : 1 / (shear_part * piece.shear());
  }

  /// Displacement by shear that is left out under a unit force, in `share` [m/N].
  ShearShare shear() const {
    ShearShare sum;
    std::map<const Region*, double> parts;
    for (std::size_t i = first_; i < last_; ++i) {
      const double part = beam(i).length * left_out(beam(i));
      sum.share += part;
      double& of_region = parts[beam(i).region];
      of_region += part;
      if (sum.region == nullptr || of_region > parts[sum.region]) sum.region = beam(i).region;
    }
    return sum;
  }

  /// Displacement by bending under a unit force across one end, whose ends turn by `yielding` under
  /// a unit moment: the moment is zero where that makes the energy least [m/N].
  double bending(const std::array<double, 2>& yielding) const {
    const double whole = length();
    double zeroth = 0;
    double first = 0;
    double second = 0;  // integrals of x^n / (E I)
    double x = 0;
    for (std::size_t i = first_; i < last_; ++i) {
      const double end = x + beam(i).length;
      const double stiffness = beam(i).bending(axis_);
      zeroth += (end - x) / stiffness;
      first += (end * end - x * x) / (2 * stiffness);
      second += (end * end * end - x * x * x) / (3 * stiffness);
      x = end;
    }
    if (std::isinf(yielding[0])) return second + whole * whole * yielding[1];
    if (std::isinf(yielding[1])) {
      return second - 2 * whole * first + whole * whole * (zeroth + yielding[0]);
    }
    const double zero = (first + whole * yielding[1]) / (zeroth + yielding[0] + yielding[1]);
    return second - 2 * zero * first + zero * zero * (zeroth + yielding[0]) +
           (whole - zero) * (whole - zero) * yielding[1];
  }

  /// Masses from one end of the member on: of points, and half of each beam [kg].
  std::vector<double> masses() const {
    std::vector<double> mass;
    for (std::size_t n = first_; n <= last_; ++n) {
      mass.push_back(chains_.point_mass(chain_.nodes[n]));
      if (n > first_) mass.back() += beam(n - 1).mass() / 2;
      if (n < last_) mass.back() += beam(n).mass() / 2;
    }
    return mass;
  }

  /// Energy of shear over that of bending under forces across a cantilever that grow with mass and
  /// distance from its foot, about as in its first mode; under one at its end if it has no mass.
  /// `yielding`: of its foot.
  double cantilever_share(bool first_is_free, double yielding) const {
    std::vector<double> force = masses();
    const std::size_t count = last_ - first_;
    if (!first_is_free) std::ranges::reverse(force);
    double above = length();
    double sheared = 0;
    double bent = 0;
    double across = 0;
    double moment = 0;
    if (std::ranges::all_of(force, [](double mass) { return mass == 0; })) force[0] = 1;
    for (std::size_t i = 0; i < count; ++i) {
      const BeamPiece& piece = beam(first_is_free ? first_ + i : last_ - 1 - i);
      across += force[i] * above;
      const double next = moment + across * piece.length;
      sheared += across * across * piece.length * left_out(piece);
      bent += (moment * moment + moment * next + next * next) * piece.length /
              (3 * piece.bending(axis_));
      moment = next;
      above -= piece.length;
    }
    return sheared / (bent + moment * moment * yielding);
  }

  const GlobalMesh& mesh_;
  const BeamChains& chains_;
  const BeamChain& chain_;
  Vector3 axis_;
  std::size_t first_;
  std::size_t last_;
};

/// Keeps the worst member of each region.
void examine(const GlobalMesh& mesh, const BeamChains& chains, const BeamChain& chain,
             std::map<const Region*, ShearShare>& worst) {
  const Matrix3& axes = chains.beam(chain.beams.front()).axes;
  for (const Vector3& axis : {axes[1], axes[2]}) {
    const Vector3 across = cross(axis, axes[0]);
    std::size_t first = 0;
    for (std::size_t last = 1; last < chain.nodes.size(); ++last) {
      const GlobalIndex node = chain.nodes[last];
      const bool ends = last + 1 == chain.nodes.size() || chains.is_clamped_along(node, across) ||
                        chains.is_clamped_about(node, axis) || chains.is_in_body(node, axis);
      if (!ends) continue;
      const ShearShare found = Member(mesh, chains, chain, axis, first, last).share();
      if (found.share > worst[found.region].share) worst[found.region] = found;
      first = last;
    }
  }
}

}  // namespace

std::vector<std::string> shear_doubts(const Structure& structure, const GlobalMesh& mesh) {
  std::vector<std::string> doubts;
  if (!structure.matrices.empty()) return doubts;
  const BeamChains chains(structure, mesh);
  std::map<const Region*, ShearShare> worst;
  for (const BeamChain& chain : chains.chains()) examine(mesh, chains, chain, worst);
  for (const Region& region : structure.regions) {
    const auto found = worst.find(&region);
    if (found == worst.end() || !(found->second.share >= doubted)) continue;
    const ShearShare& member = found->second;
    std::ostringstream text;
    text.precision(3);
    text << "structure " << structure.name << ", group " << region.group << ": "
         << (member.cantilever ? "a cantilever" : "a member") << " of beams " << member.length
         << " m long, from " << place_text(member.from) << " to " << place_text(member.to)
         << ", would be " << 100 * member.share
         << " % more flexible by shear, which it leaves out: "
         << (region.element == ElementType::beam
                 ? "give section " + region.section->name + " a shear_area"
                 : std::string("let its element be beam, with shear areas"))
         << ", or count the frequencies in which it bends as too high by about "
         << 100 * (std::sqrt(1 + member.share) - 1) << " %";
    doubts.push_back(text.str());
  }
  return doubts;
}

}  // namespace pounding
