#include "stiffness/batch_stiffness.h"

#include <algorithm>
#include <bit>
#include <span>

#include "mesh/halo.h"
#include "stiffness/element_shapes.h"
#include "stiffness/element_sorter.h"
#include "stiffness/strain_sorter.h"
#include "stiffness/strains/batch_elements.h"

namespace pounding::stiffness {
namespace {

/// Rows of a sparse matrix, each applied in the window of its lowest column.
class BatchRows {
 public:
  explicit BatchRows(const AssembledRows& matrix) {
    matrix.each_owned([&](LocalIndex row, auto columns, auto values) {
      rows_.push_back({row, {columns.begin(), columns.end()}, {values.begin(), values.end()}});
    });
    std::ranges::stable_sort(rows_, {}, lowest);
  }
  void add_to(BatchWindows& windows) const {
    for (const Row& row : rows_) windows.add(lowest(row), std::max(row.dof, row.columns.back()));
  }
  void place_in(const BatchWindows& windows) {
    begins_ = begins_in(windows, rows_, lowest);
    for (Row& row : rows_) {
      row.dof = static_cast<LocalIndex>(windows.place(row.dof));
      for (LocalIndex& column : row.columns) column = windows.place(column);
    }
  }
  void apply(std::size_t window, const BatchValue* w, BatchValue* q, StateAhead& ahead) const {
    for (std::size_t r = begins_[window]; r < begins_[window + 1]; ++r) {
      const Row& row = rows_[r];
      ahead.ask();
      BatchValue sum = q[row.dof];
      for (std::size_t k = 0; k < row.columns.size(); ++k) {
        sum += w[row.columns[k]] * row.values[k];
      }
      q[row.dof] = sum;
    }
  }

 private:
  /// Columns are sorted, the row itself is one of them.
  struct Row {
    LocalIndex dof;
    std::vector<LocalIndex> columns;
    std::vector<double> values;
  };
  static LocalIndex lowest(const Row& row) { return row.columns.front(); }

  std::vector<Row> rows_;
  std::vector<std::size_t> begins_;  ///< of each window, and the end
};

}  // namespace

struct BatchStiffness::Elements {
  explicit Elements(const ElementSorter& sorter, LocalIndex dofs)
      : general(sorter.general_elements<BatchElements>(false)),
        beams(sorter.batch_beams()),
        rows(sorter.assembled_rows()),
        windows(dofs) {
    each(*this, [&](const auto& elements) { elements.add_to(windows); });
    windows.finish();
    each(*this, [&](auto& elements) { elements.place_in(windows); });
  }
  static void each(auto& all, const auto& visit) {
    visit(all.rows);
    GeneralElementsOf<BatchElements>::each(all.general, visit);
    visit(all.beams);
  }

  GeneralElementsOf<BatchElements> general;
  BatchElements<BeamShape> beams;
  BatchRows rows;
  BatchWindows windows;
};

BatchStiffness::BatchStiffness(const Structure& structure, const Mesh& mesh)
    : dofs_(static_cast<LocalIndex>(mesh.owned_dofs)) {
  const Halo halo(mesh.comm, mesh.first_owned_dof, mesh.owned_dofs, {});
  const ElementShapes shapes(mesh);
  ElementSorter sorter(structure, mesh, shapes, halo, {.bricks = false, .rectangles = false});
  sorter.sort();
  elements_ = std::make_unique<Elements>(sorter, dofs_);
  argument_.assign(static_cast<std::size_t>(elements_->windows.ring) + 1, BatchValue{});
  force_ = argument_;
}

BatchStiffness::~BatchStiffness() = default;

double BatchStiffness::memory(const Mesh& mesh) {
  const std::size_t ring = std::bit_ceil(static_cast<std::size_t>(mesh.owned_dofs) + 1);
  double bytes = 2.0 * static_cast<double>(ring * sizeof(BatchValue));
  for (const ElementBlock& block : mesh.blocks) {
    const std::size_t size = element_layout(block.type).size();
    const ElementKernel kernel = traits_of(block.type).kernel;
    const std::size_t numbers =
        kernel == ElementKernel::brick       ? HexahedronStrains<false>::number_count
        : kernel == ElementKernel::rectangle ? QuadrangleStrains::number_count
        : kernel == ElementKernel::triangle  ? TriangleStrains::number_count
                                             : size * size;
    bytes += static_cast<double>(block.count() * (numbers + size) * sizeof(double));
  }
  return bytes;
}

void BatchStiffness::apply(const ArgumentOf<BatchValue>& w,
                           ReceiverOf<BatchValue>& receiver) const {
  const BatchWindows& windows = elements_->windows;
  LocalIndex formed = 0;
  for (std::size_t window = 0; window < windows.reach.size(); ++window) {
    for (; formed < windows.reach[window]; ++formed) {
      argument_[windows.place(formed)] = w[formed];
      force_[windows.place(formed)] = BatchValue{};
    }
    StateAhead ahead(windows, window, w.displacement, w.velocity);
    Elements::each(*elements_, [&](const auto& elements) {
      elements.apply(window, argument_.data(), force_.data(), ahead);
    });
    force_.back() = BatchValue{};
    const LocalIndex begin = static_cast<LocalIndex>(window) * BatchWindows::dofs;
    const LocalIndex end = std::min(begin + BatchWindows::dofs, dofs_);
    receiver.receive(begin, end, &force_[windows.place(begin)]);
  }
}

}  // namespace pounding::stiffness
