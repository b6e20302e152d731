#pragma once

#include <utility>

#include <petscksp.h>
#include <petscmat.h>
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

}  // namespace pounding
