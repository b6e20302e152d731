#include "output/file_blocks.h"

#include <algorithm>

#include "common/parallel.h"

namespace pounding {
namespace {

/// A row of so many doubles, as MPI counts them.
class RowType {
 public:
  explicit RowType(std::size_t columns) {
    MPI_Type_contiguous(static_cast<int>(columns), MPI_DOUBLE, &type_);
    MPI_Type_commit(&type_);
  }
  RowType(const RowType&) = delete;
  RowType& operator=(const RowType&) = delete;
  ~RowType() { MPI_Type_free(&type_); }
  MPI_Datatype get() const { return type_; }

 private:
  MPI_Datatype type_ = MPI_DATATYPE_NULL;
};

}  // namespace

FileBlocks::FileBlocks(const Mesh& mesh)
    : comm_(mesh.comm),
      order_(mesh.by_file_node),
      send_counts_(size_of(mesh.comm), 0),
      receive_counts_(size_of(mesh.comm), 0) {
  const GlobalIndex ranks = size_of(comm_);
  const GlobalIndex size = (mesh.global_nodes + ranks - 1) / ranks;
  first_ = std::min(rank_of(comm_) * size, mesh.global_nodes);
  std::vector<GlobalIndex> numbers;
  for (const LocalIndex node : order_) {
    numbers.push_back(mesh.file_node[node]);
    ++send_counts_[numbers.back() / size];
  }
  MPI_Alltoall(send_counts_.data(), 1, MPI_INT, receive_counts_.data(), 1, MPI_INT, comm_);
  send_offsets_ = starts_of(send_counts_);
  receive_offsets_ = starts_of(receive_counts_);
  std::vector<GlobalIndex> arrived(
      static_cast<std::size_t>(receive_offsets_.back() + receive_counts_.back()));
  MPI_Alltoallv(numbers.data(), send_counts_.data(), send_offsets_.data(), MPI_INT64_T,
                arrived.data(), receive_counts_.data(), receive_offsets_.data(), MPI_INT64_T,
                comm_);
  for (const GlobalIndex node : arrived) places_.push_back(static_cast<std::size_t>(node - first_));
}

void FileBlocks::to_file(std::span<const double> owned, std::size_t columns,
                         std::span<double> block) {
  of_owned_.resize(columns * order_.size());
  of_block_.resize(columns * places_.size());
  double* to = of_owned_.data();
  for (const LocalIndex node : order_) {
    to = std::copy_n(&owned[columns * static_cast<std::size_t>(node)], columns, to);
  }
  const RowType row(columns);
  MPI_Alltoallv(of_owned_.data(), send_counts_.data(), send_offsets_.data(), row.get(),
                of_block_.data(), receive_counts_.data(), receive_offsets_.data(), row.get(),
                comm_);
  for (std::size_t i = 0; i < places_.size(); ++i) {
    std::copy_n(&of_block_[columns * i], columns, &block[columns * places_[i]]);
  }
}

void FileBlocks::to_owners(std::span<const double> block, std::size_t columns,
                           std::span<double> owned) {
  of_owned_.resize(columns * order_.size());
  of_block_.resize(columns * places_.size());
  for (std::size_t i = 0; i < places_.size(); ++i) {
    std::copy_n(&block[columns * places_[i]], columns, &of_block_[columns * i]);
  }
  const RowType row(columns);
  MPI_Alltoallv(of_block_.data(), receive_counts_.data(), receive_offsets_.data(), row.get(),
                of_owned_.data(), send_counts_.data(), send_offsets_.data(), row.get(), comm_);
  const double* from = of_owned_.data();
  for (const LocalIndex node : order_) {
    std::copy_n(from, columns, &owned[columns * static_cast<std::size_t>(node)]);
    from += columns;
  }
}

}  // namespace pounding
