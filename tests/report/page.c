// report: the page. It needs no other file: drawings are inside it, as data.
#include "report.h"

#include <stdarg.h>

void page_text(FILE *page, const char *text)
{
    for (; *text; text++)
        switch (*text) {
        case '&':
            fputs("&amp;", page);
            break;
        case '<':
            fputs("&lt;", page);
            break;
        case '>':
            fputs("&gt;", page);
            break;
        case '"':
            fputs("&quot;", page);
            break;
        default:
            fputc(*text, page);
        }
}

void page_format(FILE *page, const char *format, ...)
{
    char *text = NULL;
    va_list arguments;
    va_start(arguments, format);
    if (vasprintf(&text, format, arguments) < 0)
        fail_work("the page: out of memory");
    va_end(arguments);
    page_text(page, text);
    free(text);
}

void page_begin(FILE *page)
{
    fputs("<!doctype html>\n<html lang=\"en\">\n<meta charset=\"utf-8\">\n<meta name=\"viewport\" "
          "content=\"width=device-width\">\n"
          "<title>The Voxel Light Workbook: report</title>\n<style>\n"
          "  :root { color-scheme: light dark; --ink: #1d2126; --paper: #fbfaf7; --quiet: #6a717b; --line: "
          "#d9d6ce; --bad: #b3261e; }\n"
          "  @media (prefers-color-scheme: dark) { :root { --ink: #e5e3dd; --paper: #17191c; --quiet: "
          "#979ca4; --line: #33373d; --bad: #ff8a80; } }\n"
          "  body { font: 16px/1.5 Georgia, serif; color: var(--ink); background: var(--paper); max-width: "
          "76rem; margin: 3rem auto; padding: 0 1.5rem; }\n"
          "  h1 { font-weight: normal; font-size: 2rem; margin: 0; }\n"
          "  h2 { font-weight: normal; font-size: 1.5rem; margin: 3rem 0 0; padding-top: 1rem; border-top: "
          "1px solid var(--line); }\n"
          "  h3 { font-weight: normal; font-size: 1.15rem; margin: 2rem 0 .3rem; }\n"
          "  p { max-width: 46rem; margin: .5rem 0; }\n"
          "  figure { margin: 1rem 0; } img { width: 100%; max-width: 52rem; height: auto; display: block; "
          "background: #fff; }\n"
          "  figcaption, .quiet { color: var(--quiet); font-size: .85rem; }\n"
          "  .scroll { overflow-x: auto; } table { border-collapse: collapse; font-size: .88rem; margin: "
          ".5rem 0; }\n"
          "  th, td { text-align: left; padding: .15rem .8rem .15rem 0; border-bottom: 1px solid "
          "var(--line); vertical-align: top; }\n"
          "  th { font-weight: normal; color: var(--quiet); } td { font-variant-numeric: tabular-nums; }\n"
          "  .bad { color: var(--bad); } summary { cursor: pointer; } a { color: inherit; }\n"
          "</style>\n<h1>The Voxel Light Workbook: report</h1>\n"
          "<p>Every number on this page comes from a row that a chapter's program wrote; the files lie "
          "beside the page. Run times are a software "
          "renderer's on the machine named under each figure: they do not carry over to a GPU. Counts "
          "do.</p>\n",
          page);
}

void page_end(FILE *page)
{
    fputs("</html>\n", page);
}

static void put_base64(FILE *to, const unsigned char *data, size_t bytes)
{
    static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (size_t i = 0; i < bytes; i += 3) {
        size_t left = bytes - i;
        unsigned three = (unsigned)data[i] << 16 | (left > 1 ? (unsigned)data[i + 1] << 8 : 0) |
                         (left > 2 ? (unsigned)data[i + 2] : 0);
        for (size_t k = 0; k < 4; k++)
            fputc(k <= left ? digits[three >> (18 - 6 * k) & 63] : '=', to);
    }
}

void page_figure(FILE *page, const char *folder, const char *name, const char *caption,
                 const Machine *machine)
{
    char *path = text_format("%s/%s.svg", folder, name);
    const char *slash = strrchr(folder, '/'), *last = slash ? slash + 1 : folder;
    size_t bytes = 0;
    char *drawing = file_read(path, &bytes);
    if (!drawing)
        fail_work("%s: cannot be read: %s", path, strerror(errno));
    fputs("<figure><img alt=\"", page);
    page_text(page, name);
    fputs("\" src=\"data:image/svg+xml;base64,", page);
    put_base64(page, (const unsigned char *)drawing, bytes);
    fputs("\">\n<figcaption>", page);
    page_text(page, caption);
    static const char *const endings[] = {"svg", "png", "csv"};
    for (int i = 0; i < 3; i++) {
        fputs(" <a href=\"", page);
        page_format(page, "%s/%s.%s", last, name, endings[i]);
        fprintf(page, "\">%s</a>", endings[i]);
    }
    fputs("<br>", page);
    for (int i = 0, said = 0; i < MACHINE_LINES; i++)
        if (machine->lines[i])
            page_format(page, "%s%s", said++ ? "; " : "", machine->lines[i]);
    fputs("</figcaption></figure>\n", page);
    free(drawing);
    free(path);
}

void page_row(FILE *page, const char *cell, const char *const *fields, size_t count)
{
    fputs("<tr>", page);
    for (size_t i = 0; i < count; i++) {
        fprintf(page, "<%s>", cell);
        page_text(page, fields[i]);
        fprintf(page, "</%s>", cell);
    }
    fputs("</tr>\n", page);
}

Table table_begin(FILE *page, const char *folder, const char *name, const Machine *machine,
                  const char *header)
{
    char *path = text_format("%s/%s.csv", folder, name), *names = text_format("%s", header), *rest = names;
    const char *slash = strrchr(folder, '/');
    Table table = {.page = page,
                   .csv = csv_open(path, machine, header),
                   .link = text_format("%s/%s.csv", slash ? slash + 1 : folder, name)};
    fputs("<div class=\"scroll\"><table>\n<tr>", page);
    for (char *column; (column = strsep(&rest, ",")); table.columns++) {
        for (char *c = column; *c; c++)
            *c = *c == '_' ? ' ' : *c;
        fputs("<th>", page);
        page_text(page, column);
        fputs("</th>", page);
    }
    fputs("</tr>\n", page);
    free(names);
    free(path);
    return table;
}

void table_row(Table *table, const char *const *fields)
{
    csv_row(table->csv, fields, table->columns);
    page_row(table->page, "td", fields, table->columns);
}

void table_end(Table *table)
{
    csv_close(table->csv);
    fputs("</table></div>\n<p class=\"quiet\"><a href=\"", table->page);
    page_text(table->page, table->link);
    fputs("\">csv</a></p>\n", table->page);
    free(table->link);
}
