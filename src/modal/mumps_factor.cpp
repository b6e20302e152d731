#include "modal/mumps_factor.h"

#include <algorithm>
#include <new>
#include <numeric>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <dmumps_c.h>

#include "common/memory.h"
#include "common/parallel.h"

namespace pounding {
namespace {

/// Control parameters, by their numbers in the guide of MUMPS.
enum Control {
  errors = 1,
  diagnostics = 2,
  information = 3,
  verbosity = 4,
  root_on_one_rank = 13,
  workspace = 14,
  matrix_form = 18,
  right_hand_form = 20,
  solution_form = 21,
  block_of_columns = 27,
};
constexpr int distributed_matrix = 3;
constexpr int distributed_right_hand = 10;
constexpr int distributed_solution = 1;

enum Job { start = -1, end = -2, factorisation = 2, solution = 3, analysis_and_factorisation = 4 };
constexpr int general_symmetric = 2;
constexpr int integer_workspace_too_small = -8;
constexpr int workspace_too_small = -9;
constexpr int singular = -10;
constexpr int without_memory = -13;

/// Workspace beyond MUMPS's own estimate [per cent]: at first, and at most where it was too small.
constexpr int first_workspace = 10;
constexpr int most_workspace = 1000;

/// Columns for which the factor is read once.
constexpr std::size_t portion = 16;

/// Lower triangle of the rows of a rank, counted from 1.
struct Triangle {
  std::vector<MUMPS_INT> rows, columns;
  std::vector<double> values;
};

Triangle lower_triangle(Mat matrix, double shift) {
  Triangle triangle;
  for_each_row(
      matrix, [&](PetscInt row, std::span<const PetscInt> columns, std::span<const double> values) {
        double diagonal = -shift;
        for (std::size_t k = 0; k < columns.size(); ++k) {
          if (columns[k] == row) diagonal += values[k];
          if (columns[k] >= row) continue;
          triangle.rows.push_back(row + 1);
          triangle.columns.push_back(columns[k] + 1);
          triangle.values.push_back(values[k]);
        }
        triangle.rows.push_back(row + 1);
        triangle.columns.push_back(row + 1);
        triangle.values.push_back(diagonal);
      });
  return triangle;
}

MPI_Comm communicator_of(Mat matrix) {
  MPI_Comm comm = MPI_COMM_NULL;
  POUNDING_PETSC(PetscObjectGetComm(reinterpret_cast<PetscObject>(matrix), &comm));
  return comm;
}

}  // namespace

/// A factor and the way of a solution from where MUMPS leaves it to the owners of its rows.
class MumpsFactor::Instance {
 public:
  Instance(Mat matrix, double shift) : comm_(communicator_of(matrix)), mumps_(comm_) {
    MPI_Comm_size(comm_, &ranks_);
    PetscInt size = 0;
    PetscInt first = 0;
    PetscInt end = 0;
    POUNDING_PETSC(MatGetSize(matrix, &size, nullptr));
    POUNDING_PETSC(MatGetOwnershipRange(matrix, &first, &end));
    owned_.resize(static_cast<std::size_t>(end - first));
    std::iota(owned_.begin(), owned_.end(), first + 1);
    for (const Control output : {errors, diagnostics, information, verbosity}) {
      mumps_.control(output) = 0;
    }
    mumps_.control(workspace) = first_workspace;
    mumps_.control(matrix_form) = distributed_matrix;
    if (ranks_ > 1) {
      mumps_.control(root_on_one_rank) = 1;  // or pivots are not counted
      mumps_.control(right_hand_form) = distributed_right_hand;
      mumps_.control(solution_form) = distributed_solution;
    }
    mumps_.control(block_of_columns) = portion;
    read_options();
    factorise(lower_triangle(matrix, shift), size);
  }

  int negative_pivots() const { return mumps_.global(12); }

  void solve(double* x, std::size_t columns) {
    if (singular_) throw std::runtime_error("MUMPS: the shifted matrix is singular");
    for (std::size_t first = 0; first < columns; first += portion) {
      const std::size_t count = std::min(portion, columns - first);
      double* const column = x + first * owned_.size();
      mumps_.data.nrhs = static_cast<MUMPS_INT>(count);
      ranks_ > 1 ? solve_shared(column, count) : solve_alone(column);
    }
  }

 private:
  /// Numbers of each rank on their way to it: `counts` of them, from `starts` on.
  struct Shares {
    std::vector<int> counts, starts;

    explicit Shares(std::vector<int> of) : counts(std::move(of)), starts(starts_of(counts)) {}
    std::size_t total() const { return static_cast<std::size_t>(starts.back() + counts.back()); }
  };

  /// The data of MUMPS, from its start to its end.
  class Mumps {
   public:
    explicit Mumps(MPI_Comm comm) {
      data.comm_fortran = static_cast<MUMPS_INT>(MPI_Comm_c2f(comm));
      data.par = 1;
      data.sym = general_symmetric;
      call(Job::start);
    }
    Mumps(const Mumps&) = delete;
    Mumps& operator=(const Mumps&) = delete;
    ~Mumps() { call(Job::end); }

    void call(Job job) {
      data.job = job;
      dmumps_c(&data);
    }
    MUMPS_INT& control(int number) { return data.icntl[number - 1]; }
    /// INFOG(1) and INFO(1), by their numbers.
    int global(int number) const { return data.infog[number - 1]; }
    int local(int number) const { return data.info[number - 1]; }

    DMUMPS_STRUC_C data{};
  };

  int status() const { return mumps_.global(1); }

  void require_success() const {
    if (status() >= 0) return;
    if (status() == without_memory) throw std::bad_alloc();
    throw std::runtime_error("MUMPS failed with INFOG(1) " + std::to_string(status()) +
                             ", INFOG(2) " + std::to_string(mumps_.global(2)));
  }

  void read_options() {
    constexpr int controls = 40;
    for (int number = 1; number <= controls; ++number) {
      const std::string name = "-lowest_st_mat_mumps_icntl_" + std::to_string(number);
      PetscInt value = 0;
      PetscBool given = PETSC_FALSE;
      POUNDING_PETSC(PetscOptionsGetInt(nullptr, nullptr, name.c_str(), &value, &given));
      if (given == PETSC_FALSE) continue;
      mumps_.control(number) = value;
      constexpr int standard_output = 6;  // of Fortran
      for (const Control output : {errors, diagnostics, information}) {
        if (number == verbosity) mumps_.control(output) = value > 0 ? standard_output : 0;
      }
    }
  }

  void factorise(Triangle triangle, PetscInt size) {
    mumps_.data.n = size;
    mumps_.data.nnz_loc = static_cast<MUMPS_INT8>(triangle.values.size());
    mumps_.data.irn_loc = triangle.rows.data();
    mumps_.data.jcn_loc = triangle.columns.data();
    mumps_.data.a_loc = triangle.values.data();
    mumps_.call(Job::analysis_and_factorisation);
    while ((status() == workspace_too_small || status() == integer_workspace_too_small) &&
           mumps_.control(workspace) < most_workspace) {
      mumps_.control(workspace) = 2 * std::max(mumps_.control(workspace), first_workspace);
      mumps_.call(Job::factorisation);
    }
    singular_ = status() == singular;
    if (!singular_) require_success();
    mumps_.data.irn_loc = mumps_.data.jcn_loc = nullptr;
    mumps_.data.a_loc = nullptr;
  }

  void solve_alone(double* x) {
    mumps_.data.rhs = x;
    mumps_.data.lrhs = mumps_.data.n;
    mumps_.call(Job::solution);
    require_success();
  }

  void solve_shared(double* x, std::size_t count) {
    DMUMPS_STRUC_C& data = mumps_.data;
    const auto found = static_cast<std::size_t>(mumps_.local(23));
    found_rows_.resize(std::max<std::size_t>(1, found));
    found_.resize(found_rows_.size() * portion);
    data.nloc_rhs = data.lrhs_loc = static_cast<MUMPS_INT>(owned_.size());
    data.irhs_loc = owned_.data();
    data.rhs_loc = x;
    data.lsol_loc = static_cast<MUMPS_INT>(found_rows_.size());
    data.isol_loc = found_rows_.data();
    data.sol_loc = found_.data();
    mumps_.call(Job::solution);
    require_success();
    if (!planned_) plan_exchange(found);
    exchange(x, count);
  }

  /// Which row of the solution found here goes to which rank, and where those that come belong.
  void plan_exchange(std::size_t found) {
    std::vector<int> ends(static_cast<std::size_t>(ranks_));
    const int end = owned_.empty() ? 0 : owned_.back();
    MPI_Allgather(&end, 1, MPI_INT, ends.data(), 1, MPI_INT, comm_);
    for (std::size_t r = 1; r < ends.size(); ++r) ends[r] = std::max(ends[r], ends[r - 1]);
    const auto owner = [&](std::size_t i) {
      return static_cast<std::size_t>(std::ranges::lower_bound(ends, found_rows_[i]) -
                                      ends.begin());
    };
    std::vector<int> sent(ends.size());
    for (std::size_t i = 0; i < found; ++i) ++sent[owner(i)];
    std::vector<int> received(ends.size());
    MPI_Alltoall(sent.data(), 1, MPI_INT, received.data(), 1, MPI_INT, comm_);
    sent_ = Shares(std::move(sent));
    received_ = Shares(std::move(received));
    order_.resize(found);
    std::vector<int> next = sent_.starts;
    for (std::size_t i = 0; i < found; ++i) order_[static_cast<std::size_t>(next[owner(i)]++)] = i;
    std::vector<int> rows;
    for (const std::size_t i : order_) rows.push_back(found_rows_[i]);
    places_.resize(received_.total());
    MPI_Alltoallv(rows.data(), sent_.counts.data(), sent_.starts.data(), MPI_INT, places_.data(),
                  received_.counts.data(), received_.starts.data(), MPI_INT, comm_);
    for (int& place : places_) place -= owned_.front();
    out_.resize(order_.size());
    in_.resize(places_.size());
    planned_ = true;
  }

  /// Column by column, so that numbers on their way take little memory.
  void exchange(double* x, std::size_t count) {
    for (std::size_t j = 0; j < count; ++j) {
      const double* const from = found_.data() + j * found_rows_.size();
      double* const to = x + j * owned_.size();
      for (std::size_t k = 0; k < order_.size(); ++k) out_[k] = from[order_[k]];
      MPI_Alltoallv(out_.data(), sent_.counts.data(), sent_.starts.data(), MPI_DOUBLE, in_.data(),
                    received_.counts.data(), received_.starts.data(), MPI_DOUBLE, comm_);
      for (std::size_t k = 0; k < places_.size(); ++k) to[places_[k]] = in_[k];
    }
  }

  MPI_Comm comm_;
  Mumps mumps_;
  int ranks_ = 1;
  bool singular_ = false;
  bool planned_ = false;               ///< the exchange
  std::vector<MUMPS_INT> owned_;       ///< rows of this rank, from 1
  std::vector<MUMPS_INT> found_rows_;  ///< of which MUMPS leaves the solution here, from 1
  LargeArray found_;                   ///< that solution, shape (columns, rows found)
  Shares sent_{{0}}, received_{{0}};   ///< rows
  std::vector<std::size_t> order_;     ///< of rows found, by their owner
  std::vector<int> places_;            ///< of rows received, in a column
  LargeArray out_, in_;                ///< on their way, by rank
};

MumpsFactor::MumpsFactor(Mat matrix, double shift)
    : instance_(std::make_shared<Instance>(matrix, shift)) {}

void MumpsFactor::solve(double* x, std::size_t columns) const {
  instance_->solve(x, columns);
}

int MumpsFactor::negative_pivots() const {
  return instance_->negative_pivots();
}

}  // namespace pounding
