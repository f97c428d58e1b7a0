// failure: what a function that ends the program says as it does. For Criterion tests.
#ifndef FAILURE_H
#define FAILURE_H

#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

typedef struct Failure {
    int status;         // exit status; minus the signal's number; 0 where the function returned
    char message[2048]; // all that it wrote on stderr
} Failure;

// The child ends here, after what the function itself registered: the destructors of C++ libraries would wait for threads
// that fork did not copy, for ever.
static void failure_end_child(int status, void *unused)
{
    (void)unused;
    fflush(NULL);
    _exit(status);
}

// Run the function in a child process.
static inline Failure failure_of(void (*function)(void))
{
    Failure failure = {0};
    char path[] = "/tmp/failure_XXXXXX";
    int file = mkstemp(path);
    unlink(path);
    fflush(NULL);
    pid_t child = fork();
    if (child == 0) {
        dup2(file, STDERR_FILENO);
        on_exit(failure_end_child, NULL);
        function();
        _exit(0);
    }
    int status = 0;
    waitpid(child, &status, 0);
    failure.status = WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
    ssize_t length = pread(file, failure.message, sizeof failure.message - 1, 0);
    failure.message[length > 0 ? length : 0] = '\0';
    close(file);
    return failure;
}

// Whether it is one line that holds the text. Lines that begin with == are the leak sanitizer's, which cannot work in a
// forked child and says so.
static inline bool failure_says(const Failure *failure, const char *text)
{
    const char *end = strchr(failure->message, '\n');
    return end && (end[1] == '\0' || strncmp(end + 1, "==", 2) == 0) && strstr(failure->message, text);
}

#endif
