#pragma once

#include <condition_variable>
#include <cstdio>
#include <mutex>
#include <string>
#include <thread>

#include <mpi.h>

namespace pounding {

/// Longest time between two lines of progress in a log [s].
inline constexpr double longest_silence = 60;

/// A phase of the start-up that names itself where it takes long: rank 0 prints a line after one
/// interval, then after twice as much, at most a minute apart, and a last one at the end. A thread
/// of its own prints, so that one call that takes minutes, a factorisation, is no silence; it sends
/// no messages.
class Progress {
 public:
  /// `interval` [s]; infinite: no lines. Local.
  Progress(MPI_Comm comm, std::string what, double interval, std::FILE* out = stdout);
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  ~Progress();

  /// How far the phase is: "315 products". Local, cheap, ignored on other ranks than 0.
  void at(std::string how_far);

 private:
  void watch(double interval);
  void print(const std::string& end);
  double elapsed() const;

  std::string what_;
  std::FILE* out_;
  double interval_;
  double start_;
  std::mutex mutex_;
  std::condition_variable ended_;
  std::string how_far_;
  bool over_ = false;
  bool printed_ = false;
  std::thread watcher_;
};

}  // namespace pounding
