#include "output/file_blocks.h"

#include <algorithm>

#include "common/parallel.h"

namespace pounding {
namespace {

constexpr int components = 3;

std::vector<int> offsets_of(const std::vector<int>& counts) {
  std::vector<int> offsets;
  int total = 0;
  for (const int count : counts) {
    offsets.push_back(total);
    total += count;
  }
  return offsets;
}

void multiply(std::vector<int>& counts, int factor) {
  for (int& count : counts) count *= factor;
}

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
  send_offsets_ = offsets_of(send_counts_);
  receive_offsets_ = offsets_of(receive_counts_);
  std::vector<GlobalIndex> arrived(
      static_cast<std::size_t>(receive_offsets_.back() + receive_counts_.back()));
  MPI_Alltoallv(numbers.data(), send_counts_.data(), send_offsets_.data(), MPI_INT64_T,
                arrived.data(), receive_counts_.data(), receive_offsets_.data(), MPI_INT64_T,
                comm_);
  for (const GlobalIndex node : arrived) places_.push_back(static_cast<std::size_t>(node - first_));
  for (auto* counts : {&send_counts_, &send_offsets_, &receive_counts_, &receive_offsets_}) {
    multiply(*counts, components);
  }
  sent_.resize(components * order_.size());
  received_.resize(components * places_.size());
}

void FileBlocks::exchange(std::span<const double> owned, std::span<double> block) {
  double* to = sent_.data();
  for (const LocalIndex node : order_) to = std::copy_n(&owned[components * node], components, to);
  MPI_Alltoallv(sent_.data(), send_counts_.data(), send_offsets_.data(), MPI_DOUBLE,
                received_.data(), receive_counts_.data(), receive_offsets_.data(), MPI_DOUBLE,
                comm_);
  for (std::size_t i = 0; i < places_.size(); ++i) {
    std::copy_n(&received_[components * i], components, &block[components * places_[i]]);
  }
}

}  // namespace pounding
