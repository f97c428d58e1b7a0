// say: text for a screen of 80 columns. See course.h.
#include "course.h"

#include <string.h>

enum { COLUMNS = 80, LABEL = 9, BAR = 30 };

// Characters, not bytes: what continues a character in UTF-8 is not counted.
static int width(const char *text, size_t bytes)
{
    int count = 0;
    for (size_t i = 0; i < bytes; i++)
        count += ((unsigned char)text[i] & 0xc0) != 0x80;
    return count;
}

void say_wrapped(int indent, const char *label, const char *text)
{
    int left = indent + (*label ? LABEL : 0), column = left;
    printf("%*s%s%*s", indent, "", label, *label ? LABEL - width(label, strlen(label)) : 0, "");
    for (bool first = true; *text; first = false) {
        size_t bytes = strcspn(text, " ");
        int word = width(text, bytes);
        if (!first && column + 1 + word > COLUMNS) {
            printf("\n%*s", left, "");
            column = left;
        } else if (!first) {
            putchar(' ');
            column++;
        }
        printf("%.*s", (int)bytes, text);
        column += word;
        text += bytes;
        text += *text == ' ';
    }
    putchar('\n');
}

void say_bar(int done, int of)
{
    int full = of ? BAR * done / of : 0;
    putchar('[');
    for (int i = 0; i < BAR; i++)
        putchar(i < full ? '#' : '-');
    putchar(']');
}

char *course_path(const Course *course, const Entry *entry, int file)
{
    return text_format("%s/%s/%s", course->tree, entry->folder, entry->files[file]);
}
