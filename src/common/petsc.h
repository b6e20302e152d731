#pragma once

#include <cstddef>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <mpi.h>
#include <petscksp.h>
#include <petscmat.h>
#include <petscsys.h>
#include <petscvec.h>
#include <slepceps.h>

/// Checked calls and move-only handles for PETSc and SLEPc (C builds: errors are return codes).
namespace pounding {

/// Throws std::bad_alloc when a PETSc or SLEPc function is out of memory, and std::runtime_error
/// naming the call when it reports another error.
void check_petsc(PetscErrorCode error, const char* call, const char* file, int line);

#define POUNDING_PETSC(call) ::pounding::check_petsc((call), #call, __FILE__, __LINE__)

/// Owner of one PETSc object.
template <typename Object, PetscErrorCode (*Destroy)(Object*)>
class PetscHandle {
 public:
  PetscHandle() = default;
  PetscHandle(PetscHandle&& other) noexcept : object_(std::exchange(other.object_, nullptr)) {}
  PetscHandle& operator=(PetscHandle&& other) noexcept {
    std::swap(object_, other.object_);
    return *this;
  }
  ~PetscHandle() {
    if (object_ != nullptr) Destroy(&object_);
  }

  Object get() const { return object_; }
  /// Where a PETSc function writes the object that it creates.
  Object* out() { return &object_; }

 private:
  Object object_ = nullptr;
};

using VecHandle = PetscHandle<Vec, VecDestroy>;
using MatHandle = PetscHandle<Mat, MatDestroy>;
using KspHandle = PetscHandle<KSP, KSPDestroy>;
using EpsHandle = PetscHandle<EPS, EPSDestroy>;

/// Read access to the owned entries of a vector for as long as this object lives.
class VecReader {
 public:
  explicit VecReader(Vec vector) : vector_(vector) {
    POUNDING_PETSC(VecGetArrayRead(vector_, &values_));
  }
  VecReader(const VecReader&) = delete;
  VecReader& operator=(const VecReader&) = delete;
  ~VecReader() { VecRestoreArrayRead(vector_, &values_); }
  const double* data() const { return values_; }
  double operator[](int i) const { return values_[i]; }

 private:
  Vec vector_;
  const double* values_ = nullptr;
};

/// A named event of -log_view; the same name is the same event.
class LogEvent {
 public:
  explicit LogEvent(const char* name) {
    POUNDING_PETSC(PetscLogEventRegister(name, PETSC_OBJECT_CLASSID, &event_));
  }
  PetscLogEvent get() const { return event_; }

 private:
  PetscLogEvent event_ = 0;
};

/// Charges its lifetime to an event; nothing unless PETSc logs.
class ScopedEvent {
 public:
  explicit ScopedEvent(const LogEvent& event) : event_(event.get()) {
    POUNDING_PETSC(PetscLogEventBegin(event_, 0, 0, 0, 0));
  }
  ScopedEvent(const ScopedEvent&) = delete;
  ScopedEvent& operator=(const ScopedEvent&) = delete;
  ~ScopedEvent() { static_cast<void>(PetscLogEventEnd(event_, 0, 0, 0, 0)); }

 private:
  PetscLogEvent event_;
};

/// Ends the insertion of entries into a matrix. Collective.
void assemble(Mat matrix);

/// Number of the first row of a matrix that this rank owns.
PetscInt first_row(Mat matrix);

/// A matrix with these numbers of the owned rows on its diagonal and nothing else. Collective.
MatHandle diagonal_matrix(MPI_Comm comm, std::span<const double> diagonal);

/// Calls visit(row, columns, values) for each row of a matrix that this rank owns, in their order;
/// both spans of its entries last until the next call. Local.
template <typename Visit>
void for_each_row(Mat matrix, const Visit& visit) {
  PetscInt first = 0;
  PetscInt end = 0;
  POUNDING_PETSC(MatGetOwnershipRange(matrix, &first, &end));
  for (PetscInt row = first; row < end; ++row) {
    PetscInt count = 0;
    const PetscInt* columns = nullptr;
    const PetscScalar* values = nullptr;
    POUNDING_PETSC(MatGetRow(matrix, row, &count, &columns, &values));
    const auto size = static_cast<std::size_t>(count);
    visit(row, std::span(columns, size), std::span(values, size));
    POUNDING_PETSC(MatRestoreRow(matrix, row, &count, &columns, &values));
  }
}

/// Error handler that prints nothing and keeps the message where the error began.
PetscErrorCode keep_petsc_message(MPI_Comm comm, int line, const char* function, const char* file,
                                  PetscErrorCode error, PetscErrorType type, const char* message,
                                  void* context);

/// The message kept last, in one line; "" when there was none since this was asked before.
std::string take_petsc_message();

/// PETSc and SLEPc on a communicator for as long as this object lives, with the given options and
/// no others: neither .petscrc nor variables of the environment nor .info files beside matrices are
/// read. An error inside of them prints nothing; it comes back as the exception of the call. Throws
/// std::runtime_error. Collective over the communicator.
class PetscSession {
 public:
  /// Names without the dash; "" for a flag.
  PetscSession(MPI_Comm comm, const std::map<std::string, std::string>& options);
  PetscSession(const PetscSession&) = delete;
  PetscSession& operator=(const PetscSession&) = delete;
  ~PetscSession();

 private:
  std::vector<std::string> words_;
  std::vector<char*> pointers_;  ///< to words_, then null
  int count_ = 0;
};

}  // namespace pounding
