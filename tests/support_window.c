// support_window: see support_window.h.
#include "support_window.h"

#include "model.h"

#include <fcntl.h>
#include <signal.h>
#include <stdarg.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

enum { PATIENCE_MS = 20000, STEADY_MS = 150, PAUSE_MS = 20, TICK_MS = 10 };

static struct {
    char folder[32], *window; // the X window's number
    pid_t server, program;
    int screen; // the server's own frame buffer, as a file
} at;

static long now_ms(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return now.tv_sec * 1000 + now.tv_nsec / 1000000;
}

long patience_end_ms(void)
{
    return now_ms() + PATIENCE_MS;
}

bool patience_pause(long end_ms)
{
    nanosleep(&(struct timespec){0, PAUSE_MS * 1000000L}, NULL);
    return now_ms() < end_ms;
}

// --- processes

// The first line that the shell's command prints.
static char *line_of(const char *format, ...) __attribute__((format(printf, 1, 2)));
static char *line_of(const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    char *command = NULL, *line = NULL;
    cr_assert(vasprintf(&command, format, arguments) > 0, "out of memory");
    va_end(arguments);
    FILE *from = popen(command, "r");
    size_t room = 0;
    if (getline(&line, &room, from) < 0)
        line = strcpy(line ? line : memory_new(1, 1, "a line"), "");
    line[strcspn(line, "\n")] = '\0';
    pclose(from);
    free(command);
    return line;
}

// A child that dies with this test. Its output goes to NAME.out and NAME.err in the test's folder.
static pid_t start(char *const *words, const char *name)
{
    char *out = text_format("%s/%s.out", at.folder, name), *err = text_format("%s/%s.err", at.folder, name);
    pid_t test = getpid(), child = fork();
    if (child == 0) {
        prctl(PR_SET_PDEATHSIG, SIGKILL);
        if (getppid() == test && freopen("/dev/null", "r", stdin) && freopen(out, "w", stdout) &&
            freopen(err, "w", stderr))
            execvp(words[0], words);
        _exit(127);
    }
    free(out);
    free(err);
    return child;
}

static int occurrences(const char *file, const char *words)
{
    char *path = text_format("%s/%s", at.folder, file), *text = file_read(path, NULL);
    int count = 0;
    for (const char *found = text; found && (found = strstr(found, words)); found += strlen(words))
        count++;
    free(text);
    free(path);
    return count;
}

void window_begin(void)
{
    const char *missing = system("command -v Xvfb >/dev/null")      ? "Xvfb"
                          : system("command -v xdotool >/dev/null") ? "xdotool"
                                                                    : NULL;
    if (missing)
        cr_skip_test("%s is missing; make deps-test installs it", missing);
    strcpy(at.folder, "/tmp/window-XXXXXX");
    cr_assert(mkdtemp(at.folder), "no folder in /tmp");
    char *size = text_format("%dx%dx24", SCREEN_WIDTH, SCREEN_HEIGHT);
    // -displayfd: a free display, told on stdout; -nocursor: else the pointer is in the frame buffer; -noreset: it stays for another program;
    // -r: no key repeats because its release comes late on a busy machine
    at.server = start((char *[]){"Xvfb", "-displayfd", "1", "-screen", "0", size, "-fbdir", at.folder,
                                 "-nocursor", "-noreset", "-r", "-nolisten", "tcp", NULL},
                      "server");
    free(size);
    WAIT_FOR(occurrences("server.out", "\n"), "Xvfb does not start");
    char *display = line_of("sed s/^/:/ %s/server.out", at.folder);
    setenv("DISPLAY", display, 1);
    unsetenv("WAYLAND_DISPLAY");
    free(display);
    char *frame = text_format("%s/Xvfb_screen0", at.folder);
    at.screen = open(frame, O_RDONLY | O_CLOEXEC);
    free(frame);
    free(line_of("mkdir %s/mine; ln -s \"$PWD/shaders\" %s/shaders", at.folder, at.folder));
}

void window_end(void)
{
    const pid_t children[] = {at.program, at.server};
    for (int i = 0; i < 2; i++)
        if (children[i] > 0) {
            kill(children[i], SIGKILL);
            waitpid(children[i], NULL, 0);
        }
    if (*at.folder)
        free(line_of("rm -rf %s", at.folder));
    free(at.window);
}

void window_start(const char *arguments)
{
    char *command = line_of("cd \"${BUILD:-build}\" && echo \"cd %s && exec $PWD/01_voxelization --window "
                            "--scene model.gltf --size %dx%d --set resolution=16 --shaders mine %s\"",
                            at.folder, WINDOW_WIDTH, WINDOW_HEIGHT, arguments);
    model_write(at.folder, "model", -0.25f);
    at.program = start((char *[]){"sh", "-c", command, NULL}, "program");
    free(command);
}

Pixels window_open(const char *arguments)
{
    static const Pixels black;
    window_start(arguments);
    at.window = line_of("xdotool search --sync --onlyvisible --name 01_voxelization");
    cr_assert(*at.window, "no window opens");
    window_does("mousemove 160 150"); // keys go where the pointer is
    return changed_from(&black, "the first picture");
}

const char *window_folder(void)
{
    return at.folder;
}

int window_exit_status(void)
{
    int status = 0;
    WAIT_FOR(waitpid(at.program, &status, WNOHANG) == at.program, "the program does not end");
    at.program = 0;
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

void window_does(const char *events)
{
    char *command = text_format("xdotool %s", events);
    cr_assert_eq(system(command), 0, "%s", command);
    free(command);
}

void window_resize(int width, int height)
{
    free(line_of("xdotool windowsize %s %d %d", at.window, width, height));
}

bool window_title_has(const char *words)
{
    char *title = line_of("xdotool getwindowname %s", at.window);
    const bool has = strstr(title, words);
    free(title);
    return has;
}

void expect_title(const char *words)
{
    WAIT_FOR(window_title_has(words), "the title does not come to say '%s'; it is '%s'", words,
             line_of("xdotool getwindowname %s", at.window));
}

int window_says(const char *words)
{
    return occurrences("program.out", words);
}

int window_complains(const char *words)
{
    return occurrences("program.err", words);
}

void window_file(const char *name, const char *text)
{
    char *path = text_format("%s/%s", at.folder, name), *new = text_format("%s.new", path);
    FILE *file = fopen(new, "w");
    cr_assert(file && fputs(text, file) >= 0 && fclose(file) == 0 && rename(new, path) == 0, "%s", path);
    free(new);
    free(path);
}

long window_cpu_ms(void)
{
    char *path = text_format("/proc/%d/stat", (int)at.program), *stat = file_read(path, NULL);
    long user = 0, kernel = 0;
    const char *fields = stat ? strrchr(stat, ')') : NULL;
    cr_assert(fields && sscanf(fields, ") %*c %*d %*d %*d %*d %*d %*u %*u %*u %*u %*u %ld %ld", &user,
                               &kernel) == 2,
              "the program has ended");
    free(stat);
    free(path);
    return (user + kernel) * TICK_MS;
}

// --- the screen

static Pixels screen_read(void)
{
    // An XWD file (X11/XWDFile.h), numbers of 4 bytes, big ends first: the first is the header's length, the 20th how many colours of
    // 12 bytes follow it.
    Pixels pixels;
    unsigned char header[80] = {0};
    cr_assert_eq(pread(at.screen, header, sizeof header, 0), sizeof header, "no frame buffer");
    const long before = header[2] * 256L + header[3] + 12 * (header[78] * 256L + header[79]);
    cr_assert_eq(pread(at.screen, &pixels, sizeof pixels, before), sizeof pixels, "a short frame buffer");
    return pixels;
}

int differing(const Pixels *a, const Pixels *b, Area area, int tolerance)
{
    int count = 0;
    for (int y = area.top; y < area.bottom; y++)
        for (int x = area.left; x < area.right; x++) {
            bool differs = false;
            for (int c = 0; c < 3; c++)
                differs |= abs(a->bgrx[y][x][c] - b->bgrx[y][x][c]) > tolerance;
            count += differs;
        }
    return count;
}

Pixels settled(void)
{
    Pixels last = screen_read();
    long cpu = window_cpu_ms(), since = now_ms();
    const long end = patience_end_ms();
    while (now_ms() - since < STEADY_MS) {
        cr_assert(patience_pause(end), "the window does not come to rest");
        Pixels now = screen_read();
        // at rest it still looks for saved shaders now and then: a tick of the clock may fall on that
        if (differing(&now, &last, EVERYWHERE, 0) > 0 || window_cpu_ms() > cpu + TICK_MS) {
            last = now;
            cpu = window_cpu_ms();
            since = now_ms();
        }
    }
    return last;
}

Pixels changed_from(const Pixels *before, const char *why)
{
    Pixels now = screen_read();
    WAIT_FOR((now = screen_read(), differing(&now, before, EVERYWHERE, 0) > 0),
             "nothing changes on the screen: %s", why);
    return settled();
}

void expect_same(const Pixels *before, const char *why)
{
    Pixels now = settled();
    const int count = differing(before, &now, EVERYWHERE, 0);
    cr_assert_eq(count, 0, "%s: %d pixels differ", why, count);
}
