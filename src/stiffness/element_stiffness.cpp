#include "stiffness/element_stiffness.h"

#include <algorithm>

#include <mpi.h>

#include "common/parallel.h"
#include "mesh/ghost_dofs.h"
#include "stiffness/element_sorter.h"
#include "stiffness/strain_sorter.h"

namespace pounding::stiffness {
namespace {

constexpr LocalIndex dofs_per_node = 6;

/// Counts who adds to a dof, to find the last one.
class TouchCounter {
 public:
  explicit TouchCounter(LocalIndex owned_dofs) : left_(static_cast<std::size_t>(owned_dofs), 0) {
    began_ = left_;
  }

  void expect(const std::vector<LocalIndex>& dofs) {
    for (const LocalIndex dof : dofs) ++left_[dof];
  }
  void happen(const std::vector<LocalIndex>& dofs) {
    for (const LocalIndex dof : dofs) {
      --left_[dof];
      began_[dof] = 1;
    }
  }
  bool untouched(DofRange range) const { return all_are(began_, range, 0); }
  /// Nobody is left to add to them.
  bool done(DofRange range) const { return all_are(left_, range, 0); }

 private:
  static bool all_are(const std::vector<int>& counts, DofRange range, int value) {
    return std::all_of(counts.begin() + range.begin, counts.begin() + range.end,
                       [value](int count) { return count == value; });
  }

  std::vector<int> left_;
  std::vector<int> began_;
};

/// Chains that nothing adds to after them hand over their forces.
void decide_outcomes(const std::vector<std::unique_ptr<ElementLines>>& all,
                     const ProductForms& forms, TouchCounter& counter,
                     std::vector<char>& handed_over) {
  for (const auto& lines : all) {
    std::vector<ElementLines::Outcome> outcomes;
    for (std::size_t c = 0; c < lines->chain_count(); ++c) {
      const DofRange range = lines->chain_range(c);
      const bool alone = counter.untouched(range);
      counter.happen(lines->chain_dofs(c));
      auto& outcome = outcomes.emplace_back(ElementLines::Outcome::add);
      if (forms.hand_over && (alone || forms.completed) && !range.empty() && counter.done(range)) {
        outcome = alone ? ElementLines::Outcome::hand_over : ElementLines::Outcome::complete;
        std::fill(handed_over.begin() + range.begin, handed_over.begin() + range.end, 1);
      }
    }
    lines->set_outcomes(outcomes);
  }
}

/// Adds a dof that comes after those in the ranges.
void append(std::vector<DofRange>& ranges, LocalIndex dof) {
  if (ranges.empty() || ranges.back().end != dof) ranges.push_back({dof, dof});
  ++ranges.back().end;
}

}  // namespace

ElementStiffness::ElementStiffness(const Structure& structure, const Mesh& mesh,
                                   std::unique_ptr<Stiffness> assembled, const ProductForms& forms)
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
      part.general = std::make_unique<GeneralElements>(sorter.general_elements(outer));
      part.beams = std::make_unique<BeamElements>(sorter.beam_elements(outer, idle));
      part.dofs = sorter.beam_dofs(outer);
      const std::vector<LocalIndex> dofs = sorter.general_dofs(outer);
      part.dofs.insert(part.dofs.end(), dofs.begin(), dofs.end());
    }
    sparse_ = std::make_unique<AssembledRows>(sorter.assembled_rows());
    const std::size_t places = mesh.dof_count + dofs_per_node;
    argument_ = ZeroedArray(places);
    force_ = ZeroedArray(places);
    kinds_ = sorter.kinds();
    plan(forms);
  });
  for (GlobalIndex* const count :
       {&kinds_.bricks, &kinds_.rectangles, &kinds_.general, &kinds_.beams, &kinds_.other}) {
    MPI_Allreduce(MPI_IN_PLACE, count, 1, MPI_INT64_T, MPI_SUM, mesh.comm);
  }
}

ElementStiffness::~ElementStiffness() = default;

/// Decides which chains of nodes may hand their forces over, by going through a product.
void ElementStiffness::plan(const ProductForms& forms) {
  std::vector<LocalIndex> early = inner_.dofs;
  early.insert(early.end(), sparse_->owned_rows().begin(), sparse_->owned_rows().end());
  std::vector<LocalIndex> late = outer_.dofs;
  late.insert(late.end(), sparse_->ghost_rows().begin(), sparse_->ghost_rows().end());
  TouchCounter counter(owned_dofs_);
  counter.expect(early);
  counter.expect(late);
  for (const Part* part : {&inner_, &outer_}) {
    for (const auto& lines : part->lines) {
      for (std::size_t c = 0; c < lines->chain_count(); ++c) counter.expect(lines->chain_dofs(c));
    }
  }
  std::vector<char> handed_over(owned_dofs_, 0);
  counter.happen(early);
  decide_outcomes(inner_.lines, forms, counter, handed_over);
  counter.happen(late);
  decide_outcomes(outer_.lines, forms, counter, handed_over);
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
