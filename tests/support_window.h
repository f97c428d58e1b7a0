// support_window: chapter 01's window on an X server of its own (Xvfb), real keys and mouse (xdotool), and what is on the screen.
//
// Everything waits for what it looks for, not for a fixed time, and fails the test where it does not come within 20 s. Server and
// program die with the test, however that ends.
#ifndef SUPPORT_WINDOW_H
#define SUPPORT_WINDOW_H

#include "base.h"

#include <criterion/criterion.h>
#include <time.h>

// In pixels. The window lies at the screen's 0,0 and all passes' bars fit in.
enum { SCREEN_WIDTH = 400, SCREEN_HEIGHT = 330, WINDOW_WIDTH = 320, WINDOW_HEIGHT = 300 };

// The whole screen: row from the top, column, then blue, green, red, nothing.
typedef struct Pixels {
    unsigned char bgrx[SCREEN_HEIGHT][SCREEN_WIDTH][4];
} Pixels;

// The right and bottom ends are left out.
typedef struct Area {
    int left, top, right, bottom;
} Area;
static const Area EVERYWHERE = {0, 0, SCREEN_WIDTH, SCREEN_HEIGHT};

void window_begin(void); // for TestSuite's .init; skips the test where Xvfb or xdotool is missing
void window_end(void);   // and .fini

// Run the program on the model of model.h with these further arguments, in window_folder(), where the folder mine/ is searched first for
// shaders; window_open waits for the first picture.
void window_start(const char *arguments);
Pixels window_open(const char *arguments);
const char *window_folder(void);
int window_exit_status(void); // waits for the end; 128 + signal where it was one

void window_does(const char *events); // commands of xdotool, as "key Home"
void window_resize(int width, int height);
bool window_title_has(const char *words);
void expect_title(const char *words);                 // in time
int window_says(const char *words);                   // how often, on stdout
int window_complains(const char *words);              // the same on stderr
void window_file(const char *name, const char *text); // written in the folder, in one moment
long window_cpu_ms(void);                             // of all its threads so far, a multiple of 10

int differing(const Pixels *a, const Pixels *b, Area area,
              int tolerance); // pixels, in any channel by more than the tolerance of 255
Pixels settled(void);         // the screen, once it is steady and the program has come to rest
Pixels changed_from(const Pixels *before, const char *why); // the same, once anything has changed
void expect_same(const Pixels *before, const char *why);

long patience_end_ms(void);
bool patience_pause(long end_ms); // a short pause; false where the end has passed
#define WAIT_FOR(condition, ...)                                                                             \
    for (long end_ms = patience_end_ms(); !(condition);)                                                     \
    cr_assert(patience_pause(end_ms), __VA_ARGS__)

#endif
