#pragma once

#include <memory>
#include <vector>

#include "laws/link_law.h"
#include "scene/scene.h"

namespace pounding::interactions {

/// Law of a link whose tangent k is part of K already, as in a structure reduced to the modes that
/// it has with every link at its stiffest: the pull of the link itself, less k e_n, so that both
/// together are the link. Its energy likewise, less 1/2 k e_n e_{n+1}: it is negative where K
/// counts more than the link holds.
template <typename Law>
class RelievingLaw final : public Law {
 public:
  using Law::Law;
  using Memory = LinkLaw::Memory;

  double force(double before, double now, double after, Memory memory = {}) const override {
    return Law::force(before, now, after, memory) - Law::tangent() * now;
  }
  double solve(double before, double now, double free_after, double compliance,
               Memory memory = {}) const override {
    if (this->is_explicit()) return force(before, now, free_after, memory);
    const double held = counted(now);
    return Law::solve(before, now, free_after + compliance * held, compliance, memory) - held;
  }
  double energy(double now, double after, Memory memory = {}) const override {
    return Law::energy(now, after, memory) - Law::tangent() * now * after / 2;
  }
  double tangent() const override { return 0; }
  double counted(double now) const override { return Law::tangent() * now; }
  bool is_idle(double /*now*/, Memory = {}) const override { return false; }
};

/// Whether the elements of a region are links, or hold some, or pull by a law of their own:
/// tension-only bars, compression-only springs, springs and bars that yield or have dashpots, soil
/// under a mat.
bool has_links(const Region& region);

/// Part of a spring that a link is: its dashpot, what it does along its stiffness by a law, or a
/// gauge of its elongation.
enum class SpringPart { dashpot, stiffness, gauge };

/// A link that a spring is, along or about an axis: 0 to 2 x, y, z, 3 to 5 about them; of a bar 0,
/// along its line.
struct SpringLink {
  int component = 0;
  SpringPart part = SpringPart::dashpot;
};

/// The links that each spring or bar of a region is beside what K holds of it.
std::vector<SpringLink> spring_links(const Region& region);

/// Origin of a link, from which its law follows.
struct LinkOrigin {
  const Region* region = nullptr;  ///< borrowed from the structure; null of an absorbing face
  int component = 0;          ///< along or about which a spring's dashpot or soil acts; 0 of a bar
  double length = 0;          ///< of a bar [m]
  double beta = 0;            ///< stiffness damping of its structure [s]
  bool in_stiffness = false;  ///< K of its structure holds it at its tangent already
  SpringPart part = SpringPart::dashpot;
  double share = 1;      ///< of a grounded spring, see ElementSet
  double absorbing = 0;  ///< dashpot of an absorbing face [N s/m]
};

/// Whether a link is the part along z of a compression-only spring.
bool is_pressed(const LinkOrigin& origin);

/// Law of a link by the options of its region: the only place that chooses among laws. `time_step`
/// [s]. `uniform`: damping of its structure, its reference known, which what acts in one direction
/// has as well; may be null.
std::unique_ptr<LinkLaw> law_of(const LinkOrigin& origin, double time_step,
                                const UniformDamping* uniform = nullptr);

}  // namespace pounding::interactions
