#include "stiffness/element_stiffness.h"

#include <algorithm>
#include <numeric>

#include "common/parallel.h"
#include "stiffness/element_sorter.h"
#include "stiffness/strain_sorter.h"

namespace pounding::stiffness {
namespace {

constexpr LocalIndex dofs_per_node = 6;

/// Counts who adds to a dof.
class TouchCounter {
 public:
  explicit TouchCounter(LocalIndex owned_dofs)
      : touches_(static_cast<std::size_t>(owned_dofs), 0) {}

  void add(const std::vector<LocalIndex>& dofs) {
    for (const LocalIndex dof : dofs) ++touches_[dof];
  }
  /// Nobody but one who adds to `own` adds to a range.
  bool alone(DofRange range, const std::vector<LocalIndex>& own) const {
    const auto inside = std::ranges::count_if(
        own, [range](LocalIndex dof) { return dof >= range.begin && dof < range.end; });
    return std::accumulate(touches_.begin() + range.begin, touches_.begin() + range.end,
                           std::ptrdiff_t{0}) == inside;
  }

 private:
  std::vector<int> touches_;
};

/// Chains to which nothing else adds hand over their forces.
void hand_over_alone(const std::vector<std::unique_ptr<ElementLines>>& all,
                     const TouchCounter& counter, std::vector<char>& handed_over) {
  for (const auto& lines : all) {
    std::vector<char> alone;
    for (std::size_t c = 0; c < lines->chain_count(); ++c) {
      const DofRange range = lines->chain_range(c);
      const bool hands_over = !range.empty() && counter.alone(range, lines->chain_dofs(c));
      alone.push_back(hands_over ? 1 : 0);
      if (alone.back() == 0) continue;
      std::fill(handed_over.begin() + range.begin, handed_over.begin() + range.end, 1);
    }
    lines->set_handed_over(alone);
  }
}

/// Adds a dof that comes after those in the ranges.
void append(std::vector<DofRange>& ranges, LocalIndex dof) {
  if (ranges.empty() || ranges.back().end != dof) ranges.push_back({dof, dof});
  ++ranges.back().end;
}

}  // namespace

ElementStiffness::ElementStiffness(const Structure& structure, const Mesh& mesh,
                                   std::shared_ptr<Stiffness> assembled, const ProductForms& forms)
    : owned_dofs_(mesh.owned_dofs), assembled_(std::move(assembled)) {
  const std::vector<GlobalIndex> ghosts = ghost_dofs(mesh);
  for (LocalIndex node = 0; node < mesh.owned_nodes && origin_dof_ < 0; ++node) {
    const bool moves = (mesh.free_components[node] & 0x7) == 0x7;
    origin_dof_ = moves ? mesh.dof(node, 0) : -1;
  }
  halo_ = std::make_unique<Halo>(mesh.comm, mesh.first_owned_dof, mesh.owned_dofs, ghosts);
  const ElementShapes shapes(mesh);
  on_every_rank(mesh.comm, [&] {
    ElementSorter sorter(structure, mesh, shapes, *halo_, forms);
    sorter.sort();
    const LocalIndex idle = mesh.dof_count;
    for (const bool outer : {false, true}) {
      Part& part = outer ? outer_ : inner_;
      part.lines = sorter.element_lines(outer);
      part.general =
          std::make_unique<GeneralElements>(sorter.general_elements<StrainElements>(outer));
      part.beams = std::make_unique<BeamElements>(sorter.beam_elements(outer, idle));
      part.dofs = sorter.beam_dofs(outer);
      const std::vector<LocalIndex> dofs = sorter.general_dofs(outer);
      part.dofs.insert(part.dofs.end(), dofs.begin(), dofs.end());
    }
    sparse_ = std::make_unique<AssembledRows>(sorter.assembled_rows());
    const std::size_t slots = mesh.dof_count + dofs_per_node;
    argument_ = ZeroedArray(slots);
    force_ = ZeroedArray(slots);
    kinds_ = sorter.kinds();
    plan();
  });
  reduce_over_ranks(mesh.comm, MPI_SUM, kinds_.bricks, kinds_.rectangles, kinds_.general,
                    kinds_.skew, kinds_.single, kinds_.beams, kinds_.other);
}

ElementStiffness::~ElementStiffness() = default;

/// Decides which chains of nodes may hand their forces over, by going through a product.
void ElementStiffness::plan() {
  std::vector<LocalIndex> early = inner_.dofs;
  early.insert(early.end(), sparse_->owned_rows().begin(), sparse_->owned_rows().end());
  TouchCounter counter(owned_dofs_);
  counter.add(early);
  counter.add(outer_.dofs);
  counter.add(sparse_->ghost_rows());
  for (const Part* part : {&inner_, &outer_}) {
    for (const auto& lines : part->lines) {
      for (std::size_t c = 0; c < lines->chain_count(); ++c) counter.add(lines->chain_dofs(c));
    }
  }
  std::vector<char> handed_over(owned_dofs_, 0);
  for (const Part* part : {&inner_, &outer_}) {
    hand_over_alone(part->lines, counter, handed_over);
  }
  for (LocalIndex dof = 0; dof < owned_dofs_; ++dof) {
    if (handed_over[dof] == 0) append(late_ranges_, dof);
  }
  early.insert(early.end(), outer_.dofs.begin(), outer_.dofs.end());
  std::sort(early.begin(), early.end());
  early.erase(std::unique(early.begin(), early.end()), early.end());
  for (const LocalIndex dof : early) append(general_ranges_, dof);
}

void ElementStiffness::apply(Vec w, Vec q) const {
  const VecReader reader(w);
  double* force = nullptr;
  POUNDING_PETSC(VecGetArrayWrite(q, &force));
  apply(reader.data(), force);
  POUNDING_PETSC(VecRestoreArrayWrite(q, &force));
}

void ElementStiffness::apply(const double* w, double* q) const {
  StoredForces copy(q);
  apply(StiffnessArgument{w, w, 0}, copy);
}

void ElementStiffness::finish(const StiffnessArgument& w, ForceReceiver& receiver) const {
  double* const q = force_.data();
  double* const argument = argument_.data();
  const double* const ghosts = halo_->ghosts();
  for (const DofRange& range : general_ranges_) {
    for (LocalIndex dof = range.begin; dof < range.end; ++dof) argument[dof] = w[dof];
  }
  sparse_->add_owned(argument, q);
  add_general(inner_);
  const StiffnessArgument shifted = relative_to_origin(w);
  for (const auto& lines : inner_.lines) lines->apply(shifted, ghosts, q, receiver);
  halo_->end();
  std::copy(ghosts, ghosts + halo_->ghost_count(), argument + owned_dofs_);
  add_general(outer_);
  sparse_->add_ghosts(ghosts, q);
  for (const auto& lines : outer_.lines) lines->apply(shifted, ghosts, q, receiver);
  for (const DofRange& range : late_ranges_) {
    receiver.receive(range.begin, range.end, q + range.begin);
    std::fill(q + range.begin, q + range.end, 0.0);
  }
}

/// Bricks do not feel a translation: that of one node is taken off before K multiplies its digits.
StiffnessArgument ElementStiffness::relative_to_origin(StiffnessArgument w) const {
  for (std::size_t d = 0; d < 3 && origin_dof_ >= 0; ++d) {
    w.origin[d] = w[origin_dof_ + static_cast<LocalIndex>(d)];
  }
  return w;
}

void ElementStiffness::add_general(const Part& part) const {
  part.general->apply(argument_.data(), force_.data());
  part.beams->apply(argument_.data(), force_.data());
}

}  // namespace pounding::stiffness
