#include "stiffness/batch_stiffness.h"

#include <algorithm>

#include "mesh/halo.h"
#include "stiffness/element_shapes.h"
#include "stiffness/element_sorter.h"
#include "stiffness/strain_sorter.h"

namespace pounding::stiffness {
namespace {

constexpr std::size_t dofs_per_node = 6;
constexpr std::size_t dofs_at_once = 96;  ///< handed over: whole nodes or not, all are final

}  // namespace

BatchStiffness::BatchStiffness(const Structure& structure, const Mesh& mesh)
    : dofs_(static_cast<std::size_t>(mesh.owned_dofs)),
      argument_(dofs_ + dofs_per_node, BatchValue{}),
      force_(argument_) {
  const Halo halo(mesh.comm, mesh.first_owned_dof, mesh.owned_dofs, {});
  const ElementShapes shapes(mesh);
  ElementSorter sorter(structure, mesh, shapes, halo, {.bricks = false, .rectangles = false});
  sorter.sort();
  general_ = std::make_unique<GeneralElements>(sorter.general_elements(false));
  beams_ = std::make_unique<BeamElements>(sorter.beam_elements(false, mesh.owned_dofs));
  sparse_ = std::make_unique<AssembledRows>(sorter.assembled_rows());
}

double BatchStiffness::memory(const Mesh& mesh) {
  double bytes = 2.0 * static_cast<double>(mesh.owned_dofs) * sizeof(BatchValue);
  for (const ElementBlock& block : mesh.blocks) {
    const ElementLayout layout = element_layout(block.type);
    const std::size_t size = layout.size();
    std::size_t numbers = size * size;
    switch (traits_of(block.type).kernel) {
      case ElementKernel::brick:
        numbers = HexahedronStrains<false>::number_count;
        break;
      case ElementKernel::rectangle:
        numbers = QuadrangleStrains::number_count;
        break;
      case ElementKernel::triangle:
        numbers = TriangleStrains::number_count;
        break;
      default:
        break;
    }
    bytes += static_cast<double>(block.count() * (numbers + size) * sizeof(double));
  }
  return bytes;
}

BatchStiffness::~BatchStiffness() = default;

void BatchStiffness::apply(const ArgumentOf<BatchValue>& w,
                           ReceiverOf<BatchValue>& receiver) const {
  for (std::size_t i = 0; i < dofs_; ++i) argument_[i] = w[i];
  sparse_->add_owned(argument_.data(), force_.data());
  general_->apply(argument_.data(), force_.data(), static_cast<LocalIndex>(dofs_));
  beams_->apply(argument_.data(), force_.data());
  for (std::size_t begin = 0; begin < dofs_; begin += dofs_at_once) {
    const std::size_t end = std::min(begin + dofs_at_once, dofs_);
    receiver.receive(static_cast<LocalIndex>(begin), static_cast<LocalIndex>(end), &force_[begin]);
    std::fill(&force_[begin], &force_[end], BatchValue{});
  }
}

}  // namespace pounding::stiffness
