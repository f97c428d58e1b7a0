// report: see report.h.
//
//     build/report OUT CHAPTERS NAME…      OUT/NAME/ holds the chapter's tables, CHAPTERS/NAME/report.txt what its author tells; writes OUT/index.html
#include "report.h"

static size_t stability_failed(const Chapter *chapter)
{
    size_t failed = 0;
    for (size_t row = 1; row < chapter->stability.rows; row++)
        failed += strcmp(csv_table_field(&chapter->stability, row, "verdict"), "pass") != 0;
    return failed;
}

// What there is, and what is wrong with it, before all else.
static void summary_write(FILE *page, const Chapter *chapters, size_t count)
{
    fputs("<div class=\"scroll\"><table>\n", page);
    page_row(page, "th",
             (const char *const[]){"chapter", "rows of error over run time", "stability rows that fail", "of",
                                   "not measured"},
             5);
    for (size_t i = 0; i < count; i++) {
        const Chapter *chapter = &chapters[i];
        fputs("<tr><td><a href=\"#", page);
        page_format(page, "%s", chapter->name);
        fputs("\">", page);
        page_format(page, "%s", chapter->name);
        fprintf(page, "</a></td><td>%zu</td><td>%zu</td><td>%zu</td><td>%zu</td></tr>\n", chapter->row_count,
                stability_failed(chapter), chapter->stability.rows ? chapter->stability.rows - 1 : 0,
                chapter->status.count);
    }
    fputs("</table></div>\n", page);
}

static void chapter_write(FILE *page, Chapter *chapter)
{
    fputs("<h2 id=\"", page);
    page_format(page, "%s", chapter->name);
    fputs("\">", page);
    page_format(page, "%s: %s", chapter->name, chapter->title);
    fputs("</h2>\n", page);
    status_write(page, chapter);
    fputs("<h3>Error over run time</h3>\n", page);
    if (!chapter->row_count)
        fputs("<p class=\"quiet\">No row.</p>\n", page);
    diagrams_write(page, chapter->folder, chapter->name, chapter->rows, chapter->row_count,
                   &chapter->machine);
    if (chapter->row_count)
        orders_write(page, chapter);
    budget_write(page, chapter);
    consistency_write(page, chapter->folder, (const Chapter *const[]){chapter}, 1);
    stability_write(page, chapter);
    plans_write(page, chapter);
}

// All techniques of a family on the same views. Where one chapter alone belongs to it, the chapter's own diagrams are the family's.
static void family_write(FILE *page, const char *out, const char *family, const Chapter *chapters,
                         size_t count)
{
    SweepRow *rows = NULL;
    size_t row_count = 0, of = 0;
    const Chapter *last = NULL, **members = memory_new(count, sizeof(const Chapter *), "a family's chapters");
    for (size_t i = 0; i < count; i++) {
        if (!chapter_tells(&chapters[i], "family", family, false) || !chapters[i].row_count)
            continue;
        rows = memory_grow(rows, row_count + chapters[i].row_count, sizeof *rows, "a family's rows");
        for (size_t k = 0; k < chapters[i].row_count; k++) {
            SweepRow *row = &rows[row_count++];
            *row = chapters[i].rows[k];
            row->curve = text_format("%.2s %s", chapters[i].name, row->curve);
        }
        members[of++] = &chapters[i];
        last = &chapters[i];
    }
    if (of > 1) {
        char *folder = text_format("%s/family-%s", out, family);
        folder_make(folder);
        fputs("<h2>", page);
        page_format(page, "All techniques: %s", family);
        fputs("</h2>\n", page);
        diagrams_write(page, folder, family, rows, row_count, &last->machine);
        consistency_write(page, folder, members, of);
        free(folder);
    } else if (of == 1) {
        fputs("<p class=\"quiet\">", page);
        page_format(page, "Of the family \"%s\" there is one chapter, %s: its own diagrams are the family's.",
                    family, last->name);
        fputs("</p>\n", page);
    }
    for (size_t k = 0; k < row_count; k++)
        free(rows[k].curve);
    free(rows);
    free(members);
}

int main(int argc, char **argv)
{
    if (argc < 4)
        fail_request("needed: OUT CHAPTERS NAME…, as out/report chapters 01_voxelization");
    size_t count = (size_t)argc - 3;
    Chapter *chapters = memory_new(count, sizeof *chapters, "chapters");
    for (size_t i = 0; i < count; i++)
        chapters[i] = chapter_read(argv[1], argv[2], argv[3 + i]);
    char *path = text_format("%s/index.html", argv[1]);
    const char *temporary = file_begin(path);
    FILE *page = fopen(temporary, "w");
    if (!page)
        fail_work("%s: cannot be written: %s", path, strerror(errno));
    page_begin(page);
    summary_write(page, chapters, count);
    for (size_t i = 0; i < count; i++) {
        const char *family = chapter_told(&chapters[i], "family");
        bool first = family;
        for (size_t k = 0; k < i && first; k++)
            first = !chapter_tells(&chapters[k], "family", family, false);
        if (first)
            family_write(page, argv[1], family, chapters, count);
    }
    for (size_t i = 0; i < count; i++)
        chapter_write(page, &chapters[i]);
    page_end(page);
    if (ferror(page) || fclose(page))
        fail_work("%s: cannot be written: %s", path, strerror(errno));
    file_commit(temporary);
    printf("%s\n", path);
    for (size_t i = 0; i < count; i++)
        chapter_free(&chapters[i]);
    free(chapters);
    free(path);
    return 0;
}
