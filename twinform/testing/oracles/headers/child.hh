// A function called in a fork of the process, so that one on which an engine aborts or hangs spoils no other.
#pragma once

#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <functional>
#include <iostream>
#include <string>

namespace child {

struct Ending {
  int signal = 0;       // what ended the process; 0 where it came to its own end
  std::string answer;   // what the function returned
  std::string console;  // what was written to standard output and standard error beside
  std::string stage;    // what the function reported last that it is about to do
};

// shared with the process that is watched
inline char *stage_page() {
  static char *const page = static_cast<char *>(
      mmap(nullptr, 4096, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0));
  return page;
}

inline void stage(const std::string &words) { words.copy(stage_page(), words.size() + 1), stage_page()[words.size()] = 0; }

inline std::string contents(const int file) {
  std::string text(static_cast<size_t>(lseek(file, 0, SEEK_END)), '\0');
  return pread(file, text.data(), text.size(), 0) < 0 ? "" : text;
}

inline int memory(const char *name) {
  const int file = memfd_create(name, 0);
  if (file < 0) std::abort();
  return file;
}

inline void write_all(const int file, const std::string &text) {
  for (size_t done = 0; done < text.size();) {
    const ssize_t more = write(file, text.data() + done, text.size() - done);
    if (more < 0) std::abort();
    done += static_cast<size_t>(more);
  }
}

inline Ending call(const std::function<std::string()> &function, const unsigned seconds) {
  const int answer = memory("answer"), console = memory("console");
  stage("starting");
  const pid_t process = fork();
  if (process == 0) {
    alarm(seconds);
    dup2(console, STDOUT_FILENO);
    dup2(console, STDERR_FILENO);
    write_all(answer, function());
    std::cout.flush();
    _exit(0);  // without the engines' own farewells, some of which crash
  }
  int status = 0;
  waitpid(process, &status, 0);
  Ending ending{WIFSIGNALED(status) ? WTERMSIG(status) : 0, contents(answer), contents(console), stage_page()};
  if (WIFEXITED(status) && WEXITSTATUS(status) != 0) ending.signal = SIGABRT;
  close(answer);
  close(console);
  return ending;
}

}  // namespace child
