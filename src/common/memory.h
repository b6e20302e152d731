#pragma once

#include <cstddef>
#include <cstdlib>
#include <memory>
#include <new>
#include <vector>

/// Where memory comes from and where it goes.
namespace pounding {

/// Large arrays go back to the system when they are freed, instead of staying with the process for
/// the next one. Call before anything large is allocated; does nothing where the C library cannot.
void return_large_arrays();

/// Gives freed memory back to the system, as far as the C library can.
void return_freed_memory();

/// Zeros that a step streams through: of a large array on large pages, where the system has them.
std::vector<double> zeros_on_large_pages(std::size_t size);

/// Doubles that start as zero. Of a large array only the pages that are used take memory.
class ZeroedArray {
 public:
  ZeroedArray() = default;
  explicit ZeroedArray(std::size_t size)
      : values_(static_cast<double*>(std::calloc(size, sizeof(double)))) {
    if (values_ == nullptr && size > 0) throw std::bad_alloc();
  }

  double* data() const { return values_.get(); }
  double& operator[](std::size_t i) const { return values_.get()[i]; }

 private:
  struct Free {
    void operator()(double* values) const { std::free(values); }
  };
  std::unique_ptr<double, Free> values_;
};

}  // namespace pounding
