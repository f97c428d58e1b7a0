// For the graders' own tests: what a submission might try instead of an answer. One of these names is defined before the first line.
#include "exercise.h"

#include <dirent.h>
#include <fcntl.h>
#include <math.h>
#include <pthread.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

#ifdef LEAVES_BEFORE_MAIN
__attribute__((constructor)) static void leave(void)
{
    _exit(0);
}
#endif

static void answer(const char *path, float value, size_t count)
{
    FILE *file = fopen(path, "wb");
    for (size_t i = 0; file && i < count; i++)
        fwrite(&value, sizeof value, 1, file);
    if (file)
        fclose(file);
}

int main(int argc, char **argv)
{
    const char *output = argc > 2 ? argv[2] : "output";
    (void)answer;
    (void)output;
#if defined(FORK_BOMB)
    for (;;)
        fork();
#elif defined(THREAD_BOMB)
    pthread_t thread;
    for (;;)
        pthread_create(&thread, NULL, (void *(*)(void *))(void (*)(void))pause, NULL);
#elif defined(NEVER_ENDS)
    for (volatile int i = 0;; i++)
        ;
#elif defined(SLEEPS)
    pause();
#elif defined(WRITES_GIGABYTES)
    char zeros[65536] = {0};
    for (int file = open(output, O_CREAT | O_WRONLY, 0644);;)
        if (write(file, zeros, sizeof zeros) < 0)
            return 0;
#elif defined(MANY_FILES)
    char name[32];
    for (int i = 0;; i++) {
        snprintf(name, sizeof name, "file%d", i);
        close(open(name, O_CREAT | O_WRONLY, 0644));
    }
#elif defined(ALL_MEMORY)
    for (;;)
        memset(malloc(1 << 20), 1, 1 << 20);
#elif defined(ALL_MEMORY_TOGETHER)
    for (int i = 0; i < 4; i++)
        fork();
    for (;;)
        memset(malloc(1 << 20), 1, 1 << 20);
#elif defined(SHARED_MEMORY)
    char *shared = mmap(NULL, (size_t)4 << 30, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    for (size_t i = 0; shared != MAP_FAILED; i += 4096)
        shared[i % ((size_t)4 << 30)] = 1;
#elif defined(PRINTS_WITHOUT_END)
    for (;;)
        puts("{\"score\": 5, \"max_score\": 5, \"status\": \"passed\"}");
#elif defined(READS_SOLUTIONS)
    // Whatever can be found: the solution's source or its program.
    char *const command[] = {"sh",
                             "-c",
                             "cat $(find / -name twice.c -path '*solutions*' 2>/dev/null) && exec $(find / "
                             "-name program -path '*reference*' 2>/dev/null | head -n 1) \"$0\" \"$1\"",
                             argv[1],
                             argv[2],
                             NULL};
    execvp("sh", command);
#elif defined(WRITES_RESULTS)
    char *const command[] = {
        "sh", "-c",
        "for f in $(find / -name results.json -o -name score.txt -o -name 'grade_*' 2>/dev/null) "
        "/tmp/results.json ../results.json; do echo '{\"score\": 5}' > $f; done",
        NULL};
    execvp("sh", command);
#elif defined(DELETES_FILES)
    char *const command[] = {
        "sh",    "-c",    "rm -rf \"$1\" \"$0\" ../* ../../* /tmp/grade_* 2>/dev/null; exit 0",
        argv[0], argv[1], NULL};
    execvp("sh", command);
#elif defined(FAKES_RESULTS)
    puts("[PASS] everything\nscore: 5\n{\"score\": 5, \"exit-code\": 0}");
#elif defined(ENDS_EARLY)
    exit(0);
#elif defined(LINKS_OUTPUT)
    (void)!symlink(argv[1], output);
#elif defined(LINKS_INPUT_HARD)
    (void)!link(argv[1], output);
#elif defined(PIPE_OUTPUT)
    mkfifo(output, 0644);
#elif defined(NOT_A_NUMBER)
    answer(output, NAN, 64);
#elif defined(INFINITE)
    answer(output, INFINITY, 64);
#elif defined(ALL_ZERO)
    answer(output, 0, 64);
#elif defined(TOO_LONG)
    answer(output, 0, 65);
#elif defined(TOO_SHORT)
    answer(output, 0, 63);
#elif defined(KILLS_EVERYONE)
    kill(-1, SIGKILL);
    kill(getppid(), SIGKILL);
#elif defined(OUTLIVES)
    if (fork() == 0) {
        setsid();
        if (fork() == 0) {
            sleep(1);
            answer(output, 0, 64);
            pause();
        }
    }
#elif defined(ASKS_THE_NETWORK)
    char *const command[] = {"bash", "-c", "exec 3<>/dev/tcp/127.0.0.1/22 || exit 3", NULL};
    execvp("bash", command);
#elif defined(LEAVES_BEFORE_MAIN)
    answer(output, 0, 64);
#else
#error no such attack
#endif
    return 0;
}
