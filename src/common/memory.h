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

/// Memory that the system could still give [bytes]; infinite where it does not say.
double available_memory();

/// Gives freed memory back to the system, as far as the C library can.
void return_freed_memory();

/// Threads that are started later take memory from one pool: with one each, a thread would reserve
/// 64 MB of addresses, and 128 MB for a moment, under a limit that the run may need.
void share_memory_among_threads();

/// The system may give these bytes large pages, as far as they fill such. A wish: small ones do as
/// well.
void wish_large_pages(void* bytes, std::size_t count);

/// Zeros that a step streams through: of a large array on large pages, where the system has them.
template <typename Value = double>
std::vector<Value> zeros_on_large_pages(std::size_t size) {
  std::vector<Value> zeros;
  zeros.reserve(size);
  wish_large_pages(zeros.data(), size * sizeof(Value));
  zeros.resize(size, Value{});
  return zeros;
}

/// Bytes that memory hands over at once.
inline constexpr std::size_t cache_line = 64;

/// Memory that begins with a cache line: vectors of it, counted in whole ones, cross none.
template <typename Value>
struct CacheLineAllocator {
  using value_type = Value;
  static constexpr std::align_val_t line{cache_line};

  CacheLineAllocator() = default;
  template <typename Other>
  CacheLineAllocator(const CacheLineAllocator<Other>&) {}

  Value* allocate(std::size_t count) {
    return static_cast<Value*>(::operator new(count * sizeof(Value), line));
  }
  void deallocate(Value* values, std::size_t) { ::operator delete(values, line); }
  template <typename Other>
  bool operator==(const CacheLineAllocator<Other>&) const {
    return true;
  }
};

/// Gives the memory of these bytes back as far as they fill pages, their addresses not: they are
/// lost, and may be written anew.
void return_pages(void* bytes, std::size_t count);

/// Memory of large arrays on large pages, where the system has them: ordinary ones of 4 kB are
/// asked for one by one, whenever such an array is made.
template <typename Value>
struct LargePageAllocator {
  using value_type = Value;
  static constexpr std::size_t page = std::size_t{1} << 21;  // [B]

  LargePageAllocator() = default;
  template <typename Other>
  LargePageAllocator(const LargePageAllocator<Other>&) {}

  Value* allocate(std::size_t count) {
    const std::size_t bytes = count * sizeof(Value);
    void* const memory = ::operator new(bytes, alignment(count));
    if (bytes >= page) wish_large_pages(memory, bytes);
    return static_cast<Value*>(memory);
  }
  void deallocate(Value* values, std::size_t count) { ::operator delete(values, alignment(count)); }
  template <typename Other>
  bool operator==(const LargePageAllocator<Other>&) const {
    return true;
  }

 private:
  static std::align_val_t alignment(std::size_t count) {
    return std::align_val_t{count * sizeof(Value) >= page ? page : cache_line};
  }
};

/// Doubles of which there may be very many.
using LargeArray = std::vector<double, LargePageAllocator<double>>;

/// Doubles for work in vectors.
using LaneArray = std::vector<double, CacheLineAllocator<double>>;

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

/// Resident memory of a process [bytes]; shared memory counts on each of its ranks.
struct MemoryUse {
  double held = 0;  ///< now
  double peak = 0;  ///< largest since the last time that somebody asked
};

/// Memory of this process; begins a new peak where the system lets it, else `peak` is that since
/// the process began.
MemoryUse take_memory_use();

/// Largest resident memory of this process so far [bytes], whoever asked before.
double largest_memory();

/// Largest resident memory of a process that this one started and that ended [bytes].
double largest_memory_of_children();

}  // namespace pounding
