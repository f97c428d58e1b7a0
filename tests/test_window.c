// The window, as a user meets it: each test opens it on an X server of its own, presses keys and drags the mouse, and compares the screen
// before and after: it differs where it must and nowhere else.
#include "image.h"
#include "support_window.h"

#include <math.h>
#include <string.h>
#include <unistd.h>

#define SHADER_BROKEN "void main()\n{\n    float broken = ;\n}\n"
// All that the walk gives becomes blue: valid, and another picture.
#define SHADER_BLUE "out vec4 color;\n\nvoid main()\n{\n    color = vec4(0.0, 0.0, 1.0, 1.0);\n}\n"
enum { BORDER_PIXELS = 6 };

TestSuite(window, .init = window_begin, .fini = window_end, .timeout = 120);

static int lit_pixels(const Pixels *pixels)
{
    static const Pixels black;
    return differing(pixels, &black, EVERYWHERE, 0);
}

// --- the controls

Test(window, camera_orbits_zooms_and_comes_home)
{
    Pixels first = window_open("--step mesh");
    window_does("mousedown 1 mousemove 200 130 mouseup 1");
    Pixels turned = changed_from(&first, "left drag");
    window_does("mousemove 160 150"); // without a button nothing moves
    expect_same(&turned, "the mouse without a button");
    window_does("key Home");
    changed_from(&turned, "Home");
    expect_same(&first, "Home is not the camera as set");
    window_does("mousedown 1 mousemove 200 130 mouseup 1");
    Pixels again = changed_from(&first, "left drag");
    expect_same(&turned, "the same drag turns elsewhere");
    window_does("mousedown 1 mousemove 160 150 mouseup 1");
    Pixels back = changed_from(&again, "left drag back");
    // Rounding may move an edge by a pixel: 1 % of 96000 pixels is below half of the lines' length.
    cr_expect_lt(differing(&first, &back, EVERYWHERE, 8), 960, "dragging back does not undo dragging");
    window_does("key Home");
    window_does("click 4"); // a notch: 0.9 of the distance, which is that to the wall
    Pixels near = changed_from(&first, "the wheel");
    double ratio = (double)lit_pixels(&near) / lit_pixels(&first);
    cr_expect_float_eq(ratio, 1 / 0.81, 0.03, "a notch makes the wall %g times as large",
                       ratio); // a row of 250 pixels
    window_does("key Home");
    changed_from(&near, "Home after the wheel");
    expect_same(&first, "Home is not the camera as set");
}

// Which of blue, green, red differ.
static int channels_differing(const Pixels *a, const Pixels *b)
{
    int channels = 0;
    for (int y = 0; y < SCREEN_HEIGHT; y++)
        for (int x = 0; x < SCREEN_WIDTH; x++)
            for (int c = 0; c < 3; c++)
                channels |= (a->bgrx[y][x][c] != b->bgrx[y][x][c]) << c;
    return channels;
}

Test(window, lights_move_and_change)
{
    Pixels first = window_open("--step mesh --set light=0");
    window_does("mousedown 3 mousemove 200 150 mouseup 3");
    Pixels moved = changed_from(&first, "right drag");
    cr_expect_eq(channels_differing(&first, &moved), 2,
                 "light 0 is green: moving it changed another channel");
    for (int i = 0; i < 20 && !window_title_has("light = 0"); i++)
        window_does("key Tab");
    expect_title("light = 0");
    window_does("key l"); // the next light; the last one goes back to where the file has it
    expect_title("light = 1");
    expect_same(&first, "all lights shine, whichever is chosen");
    window_does("mousemove 160 150 mousedown 3 mousemove 200 150 mouseup 3");
    moved = changed_from(&first, "right drag of light 1");
    cr_expect_eq(channels_differing(&first, &moved), 4, "light 1 is red: moving it changed another channel");
    window_does("key Up"); // the parameter that the title names: after the last light comes the first
    expect_title("light = 0");
    expect_same(&first, "a light does not go back to its place");
    window_does("key Down");
    expect_title("light = 1");
}

Test(window, steps_go_back_and_on)
{
    Pixels walk = window_open(""), steps[3];
    const char *const titles[] = {"step exact", "step holes", "step mesh"};
    expect_title("step walk");
    const Pixels *last = &walk;
    for (int i = 0; i < 3; i++) {
        window_does("key bracketleft");
        steps[i] = changed_from(last, titles[i]);
        expect_title(titles[i]);
        last = &steps[i];
    }
    window_does("key bracketleft"); // before the first is none
    expect_same(&steps[2], "before the first step");
    expect_title("step mesh");
    for (int i = 1; i >= 0; i--) {
        window_does("key bracketright");
        changed_from(&steps[i + 1], titles[i]);
        expect_same(&steps[i], "a step again is another picture"); // what its passes need was built anew
    }
    window_does("key bracketright bracketright");
    changed_from(&steps[0], "step walk");
    expect_same(&walk, "the last step again is another picture");
}

Test(window, a_step_builds_what_it_needs)
{
    Pixels last = window_open("--step mesh"); // nothing that voxels need has been built
    const char *const titles[] = {"step holes", "step exact", "step walk"};
    for (int i = 0; i < 3; i++) {
        window_does("key bracketright");
        last = changed_from(&last, titles[i]);
        expect_title(titles[i]);
        window_does("key p");
        Pixels bars = changed_from(&last, "P"); // these build everything anew
        window_does("key p");
        changed_from(&bars, "P again");
        expect_same(&last, titles[i]);
    }
}

Test(window, parameters_are_chosen_and_changed)
{
    Pixels first = window_open("");
    expect_title("method = exact");
    window_does("key Tab");
    expect_title("resolution = 16");
    expect_same(&first, "Tab");
    window_does("key Up");
    Pixels finer = changed_from(&first, "resolution up");
    expect_title("resolution = 32");
    window_does("key Down");
    changed_from(&finer, "resolution down");
    expect_title("resolution = 16");
    expect_same(&first, "resolution 16 again is another picture");
    window_does("key Tab");
    expect_title("show = shaded");
    window_does("key Down"); // before the first choice is the last
    Pixels shown = changed_from(&first, "another way to show voxels");
    expect_title("show = mean_normals");
    window_does("key Up");
    changed_from(&shown, "and back");
    expect_title("show = shaded");
    expect_same(&first, "the first way again is another picture");
    for (int i = 0; i < 20 && !window_title_has("exposure"); i++)
        window_does("key Tab");
    expect_title("exposure = 0"); // vectors are left out, numbers are not
    window_does("key Down");
    Pixels darker = changed_from(&first, "exposure");
    int brighter = 0;
    for (int y = 0; y < WINDOW_HEIGHT; y++)
        for (int x = 0; x < WINDOW_WIDTH; x++)
            brighter += darker.bgrx[y][x][1] > first.bgrx[y][x][1];
    cr_expect_eq(brighter, 0, "%d pixels are brighter at a lower exposure", brighter);
}

Test(window, passes_are_shown_as_bars_over_the_picture)
{
    Pixels first = window_open("");
    window_does("key p");
    Pixels bars = changed_from(&first, "P");
    WAIT_FOR(window_says("G-buffer"), "no table of the passes in the terminal");
    const Area below = {0, WINDOW_HEIGHT, SCREEN_WIDTH, SCREEN_HEIGHT},
               right = {244, 0, SCREEN_WIDTH, WINDOW_HEIGHT};
    cr_expect_eq(differing(&first, &bars, below, 0) + differing(&first, &bars, right, 0), 0,
                 "the bars, 240 pixels long, reach farther");
    const Area gap = {0, 14, 244, 18}; // between the first bar and the second
    cr_expect_eq(differing(&first, &bars, gap, 0), 0, "the picture between the bars is not the same");
    cr_expect_gt(differing(&first, &bars, (Area){4, 4, 244, 14}, 0), 1000, "where is the first bar?");
    window_does("key p");
    changed_from(&bars, "P again");
    expect_same(&first, "without the bars the picture is another");
}

Test(window, keys_that_change_no_pixel)
{
    Pixels first = window_open("");
    cr_expect_eq(window_says("left drag: orbit"), 1, "the keys are told at the start");
    window_does("key h");
    WAIT_FOR(window_says("left drag: orbit") == 2, "H tells no keys");
    expect_same(&first, "H");
    window_does("key r");
    WAIT_FOR(window_says(" shaders compiled\n") == 1, "R compiles nothing");
    expect_same(&first, "R");
    window_does("key s");
    char *path = text_format("%s/out/01_voxelization-1.png", window_folder());
    WAIT_FOR(access(path, F_OK) == 0, "S: no %s", path);
    expect_same(&first, "S");
    Image shot = image_read(path);
    cr_assert(shot.width == WINDOW_WIDTH && shot.height == WINDOW_HEIGHT, "the screenshot is %dx%d",
              shot.width, shot.height);
    int wrong = 0;
    for (int i = 0; i < WINDOW_WIDTH * WINDOW_HEIGHT * 3; i++) {
        float v = shot.pixels[i]; // back to the 256 levels of the file: IEC 61966-2-1
        float level = 255 * (v <= 0.0031308f ? 12.92f * v : 1.055f * powf(v, 1 / 2.4f) - 0.055f);
        int on_screen = first.bgrx[i / 3 / WINDOW_WIDTH][i / 3 % WINDOW_WIDTH][2 - i % 3];
        wrong += fabsf(level - (float)on_screen) > 1.01f; // GL may round a half to either side
    }
    cr_expect_eq(wrong, 0, "%d values of the screenshot are not the window's", wrong);
    image_free(&shot);
    free(path);
    window_does("key s");
    path = text_format("%s/out/01_voxelization-2.png", window_folder());
    WAIT_FOR(access(path, F_OK) == 0, "the second screenshot replaces the first");
    free(path);
}

// --- shaders saved while the window is open

static void expect_border(const Pixels *picture, const char *when)
{
    const Area inside = {BORDER_PIXELS, BORDER_PIXELS, WINDOW_WIDTH - BORDER_PIXELS,
                         WINDOW_HEIGHT - BORDER_PIXELS},
               right = {WINDOW_WIDTH, 0, SCREEN_WIDTH, SCREEN_HEIGHT},
               below = {0, WINDOW_HEIGHT, WINDOW_WIDTH, SCREEN_HEIGHT};
    Pixels now = settled();
    cr_expect_eq(differing(picture, &now, inside, 0), 0, "%s: the last picture is lost", when);
    cr_expect_eq(differing(picture, &now, right, 0) + differing(picture, &now, below, 0), 0,
                 "%s: something is drawn outside", when);
    int not_red = 0;
    for (int y = 0; y < WINDOW_HEIGHT; y++)
        for (int x = 0; x < WINDOW_WIDTH; x++)
            if (x < inside.left || x >= inside.right || y < inside.top || y >= inside.bottom)
                not_red += now.bgrx[y][x][2] < 200 || now.bgrx[y][x][0] > 50 || now.bgrx[y][x][1] > 50;
    cr_expect_eq(not_red, 0, "%s: %d pixels of the border are not red", when, not_red);
}

Test(window, shader_errors_are_shown_around_the_last_picture)
{
    Pixels first = window_open("");
    window_file("mine/walk.frag", SHADER_BROKEN); // a file that hides the chapter's own
    changed_from(&first, "a shader with an error");
    expect_border(&first, "saved with an error");
    expect_title("shader error: mine/walk.frag:3: ");
    cr_expect_eq(window_complains("mine/walk.frag:3: "), 1, "not one line in the terminal");
    window_does("mousedown 1 mousemove 200 150 mouseup 1"); // the last good shader goes on
    expect_title("shader error: ");
    window_does("key Home");
    expect_border(&first, "after an orbit and Home");
    window_file("mine/walk.frag", SHADER_BLUE);
    WAIT_FOR(!window_title_has("shader error"), "the error stays after the repair");
    Pixels blue = settled();
    int others = 0; // 0, 0, 1 at exposure 0
    for (int y = 0; y < WINDOW_HEIGHT; y++)
        for (int x = 0; x < WINDOW_WIDTH; x++)
            others += memcmp(blue.bgrx[y][x], (const unsigned char[]){255, 0, 0}, 3) != 0;
    cr_expect_eq(others, 0, "%d pixels are not what the shader says", others);
    char *path = text_format("%s/mine/walk.frag", window_folder());
    unlink(path);
    free(path);
    changed_from(&blue, "the chapter's own shader again");
    expect_same(&first, "the repaired shader gives another picture");
    cr_expect_eq(window_complains("\n"), 2,
                 "the terminal has a note on the model and one error"); // no more lines
}

Test(window, an_error_in_the_shader_that_shows_pictures_is_shown_too)
{
    Pixels first = window_open("");
    window_file("mine/present.frag", SHADER_BROKEN);
    changed_from(&first, "a shader with an error");
    expect_border(&first, "saved with an error");
    window_does("key r"); // it still stands
    WAIT_FOR(window_complains("mine/present.frag:3: ") == 2, "R does not say the error again");
    expect_border(&first, "after R");
    char *path = text_format("%s/mine/present.frag", window_folder());
    unlink(path);
    free(path);
    WAIT_FOR(!window_title_has("shader error"), "the error stays after the repair");
    expect_same(&first, "the repaired shader gives another picture");
}

// --- size, rest and end

Test(window, resizing_makes_the_picture_anew)
{
    Pixels first = window_open("");
    window_resize(WINDOW_WIDTH / 2, WINDOW_HEIGHT);
    Pixels narrow = changed_from(&first, "a narrower window");
    window_does("key s");
    char *path = text_format("%s/out/01_voxelization-1.png", window_folder());
    WAIT_FOR(access(path, F_OK) == 0, "S: no %s", path);
    Image shot = image_read(path);
    cr_expect(shot.width == WINDOW_WIDTH / 2 && shot.height == WINDOW_HEIGHT, "the picture is %dx%d",
              shot.width, shot.height);
    image_free(&shot);
    free(path);
    window_does("key p");
    window_resize(1, 1); // smaller than border and bars: nothing may go wrong
    changed_from(&narrow, "the smallest window");
    window_resize(WINDOW_WIDTH, WINDOW_HEIGHT);
    WAIT_FOR((narrow = settled(), differing(&first, &narrow, (Area){244, 0, 320, 300}, 0) == 0),
             "the first size again is another picture");
    window_does("key p");
    changed_from(&narrow, "the bars go");
    expect_same(&first, "the first size again is another picture");
}

Test(window, rests_while_nothing_changes_and_closes_by_escape)
{
    window_open("");
    const long before = window_cpu_ms();
    nanosleep(&(struct timespec){1, 0}, NULL); // the second that is measured
    const long used = window_cpu_ms() - before;
    cr_expect_lt(used, 200, "%ld ms of a second while nothing changes",
                 used); // drawing on would take all of it
    window_does("key Escape");
    cr_expect_eq(window_exit_status(), 0, "closed by Escape");
}

Test(window, ends_by_itself_after_the_frames_asked_for)
{
    window_start("--frames 3 --path orbit --out last.png");
    cr_expect_eq(window_exit_status(), 0, "three frames");
    char *path = text_format("%s/last.png", window_folder());
    cr_expect_eq(access(path, F_OK), 0, "--out beside --window wrote nothing");
    free(path);
    window_start("--frames 1000000 --path orbit"); // an animation can be closed at any time
    WAIT_FOR(window_says("Esc: close"), "no window opens");
    window_does("search --sync --onlyvisible --name 01_voxelization mousemove 160 150 key Escape");
    cr_expect_eq(window_exit_status(), 0, "closed by Escape in an animation");
}
