// A process that is timed: paths on standard input, and for each a line with the CPU seconds of one call, or after `!`
// why there are none. A call that takes little is repeated until so many seconds are over, and the mean is told.
#pragma once

#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <functional>
#include <iostream>
#include <string>

namespace turns {

inline double cpu_seconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + static_cast<double>(now.tv_nsec) * 1e-9;
}

// the call is given a path, and returns why the file is refused; nothing where it is not
inline int serve(const double least, const std::function<std::string(const std::string &)> &call) {
  FILE *const answers = fdopen(dup(STDOUT_FILENO), "w");
  dup2(STDERR_FILENO, STDOUT_FILENO);  // what the library prints is no answer
  for (std::string path; std::getline(std::cin, path);) {
    const double start = cpu_seconds();
    double taken = 0;
    int count = 0;
    std::string refused;
    while (refused.empty() && (count == 0 || taken < least)) {
      refused = call(path);
      taken = cpu_seconds() - start;
      ++count;
    }
    if (refused.empty()) std::fprintf(answers, "%.9f\n", taken / count);
    else std::fprintf(answers, "! %s\n", refused.substr(0, refused.find('\n')).c_str());
    std::fflush(answers);
  }
  return 0;
}

}  // namespace turns
