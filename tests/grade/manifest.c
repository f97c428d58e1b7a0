// manifest: see manifest.h.
#include "manifest.h"
#include "inputs.h"
#include "schema.h"

#include <stdlib.h>
#include <string.h>

// --- from JSON, whose form the schema has vouched for
static const char *text_of(json_t *object, const char *key)
{
    return json_string_value(json_object_get(object, key));
}

static const char **texts_of(json_t *object, const char *key, int *count)
{
    json_t *array = json_object_get(object, key);
    *count = (int)json_array_size(array);
    const char **texts = memory_new((size_t)*count, sizeof *texts, key);
    for (int i = 0; i < *count; i++)
        texts[i] = json_string_value(json_array_get(array, (size_t)i));
    return texts;
}

static Shape shape_of(json_t *output)
{
    json_t *size = json_object_get(output, "size"), *channels = json_object_get(output, "channels");
    Shape shape = {.of = text_of(output, "of"), .unit = text_of(output, "unit")};
    shape.dimensions = (int)json_array_size(size);
    for (int k = 0; k < 3; k++)
        shape.size[k] = k < shape.dimensions ? (int)json_integer_value(json_array_get(size, (size_t)k)) : 1;
    shape.channels = channels ? (int)json_array_size(channels) : 1;
    for (int c = 0; c < shape.channels; c++)
        shape.channel_names[c] = json_string_value(json_array_get(channels, (size_t)c));
    return shape;
}

static Check check_of(json_t *object)
{
    json_t *tolerance = json_object_get(object, "tolerance");
    return (Check){.name = text_of(object, "name"),
                   .asks = text_of(object, "asks"),
                   .points = json_number_value(json_object_get(object, "points")),
                   .input = text_of(object, "input"),
                   .shape = shape_of(json_object_get(object, "output")),
                   .tolerance = {json_number_value(json_object_get(tolerance, "absolute")),
                                 json_number_value(json_object_get(tolerance, "relative"))},
                   .because = text_of(object, "because")};
}

// A check that it names and that does not exist is NULL, which check_entry objects to.
static Misconception misconception_of(const Entry *entry, json_t *object)
{
    Misconception misconception = {.mutant = text_of(object, "mutant"), .says = text_of(object, "says")};
    misconception.seen_in = entry_check(entry, text_of(object, "seen_in"));
    const char **names = texts_of(object, "loses", &misconception.loses_count);
    misconception.loses = memory_new((size_t)misconception.loses_count, sizeof(Check *), "loses");
    for (int i = 0; i < misconception.loses_count; i++)
        misconception.loses[i] = entry_check(entry, names[i]);
    free(names);
    return misconception;
}

static Entry entry_of(json_t *object)
{
    Entry entry = {.id = text_of(object, "id"),
                   .title = text_of(object, "title"),
                   .goal = text_of(object, "goal"),
                   .folder = text_of(object, "folder"),
                   .minutes = (int)json_integer_value(json_object_get(object, "minutes"))};
    entry.program = text_format("%s", entry.id);
    entry.program[2] = '_';
    const char *kind = text_of(object, "kind");
    entry.kind = *kind == 'p' ? EXERCISE_PRACTICE : *kind == 'g' ? EXERCISE_GRADED : EXERCISE_MEASURE;
    entry.read = texts_of(object, "read", &entry.read_count);
    entry.files = texts_of(object, "files", &entry.file_count);
    entry.builds_on = texts_of(object, "builds_on", &entry.builds_on_count);
    for (int i = 0; i < 3; i++)
        entry.hints[i] = json_string_value(json_array_get(json_object_get(object, "hints"), (size_t)i));
    json_t *checks = json_object_get(object, "checks"), *wrong = json_object_get(object, "misconceptions");
    entry.check_count = (int)json_array_size(checks);
    entry.checks = memory_new((size_t)entry.check_count, sizeof *entry.checks, "checks");
    for (int i = 0; i < entry.check_count; i++)
        entry.checks[i] = check_of(json_array_get(checks, (size_t)i));
    entry.misconception_count = (int)json_array_size(wrong);
    entry.misconceptions =
        memory_new((size_t)entry.misconception_count, sizeof *entry.misconceptions, "misconceptions");
    for (int i = 0; i < entry.misconception_count; i++)
        entry.misconceptions[i] = misconception_of(&entry, json_array_get(wrong, (size_t)i));
    return entry;
}

// --- what no schema can say. Each returns NULL or the objection.
static char *check_check(const Entry *entry, const Check *check)
{
    const char *id = entry->id;
    if (entry_check(entry, check->name) != check)
        return text_format("%s: two checks are called %s", id, check->name);
    if ((check->points > 0) != (entry->kind != EXERCISE_PRACTICE))
        return text_format("%s: check %s has %g points; practice has none, any other kind more than 0", id,
                           check->name, check->points);
    if (!(check->tolerance.absolute + check->tolerance.relative > 0))
        return text_format("%s: check %s: the tolerance is 0; whole numbers take an absolute 0.25", id,
                           check->name);
    if ((check->input == NULL) != (entry->kind == EXERCISE_MEASURE))
        return text_format("%s: check %s: an input is for programs, and each of theirs has one", id,
                           check->name);
    if (check->input && !input_known(check->input))
        return text_format("%s: check %s: no generator of tests/grade/inputs*.c is called %s", id,
                           check->name, check->input);
    if (entry->kind == EXERCISE_MEASURE && check_values(check) != 1)
        return text_format("%s: check %s: an answer is one number", id, check->name);
    return NULL;
}

static char *check_misconception(const Entry *entry, const Misconception *misconception)
{
    bool seen = false;
    for (int i = 0; i < misconception->loses_count; i++) {
        if (!misconception->loses[i])
            return text_format("%s: misconception %s loses a check that does not exist", entry->id,
                               misconception->mutant);
        seen = seen || misconception->loses[i] == misconception->seen_in;
    }
    if (!seen)
        return text_format("%s: misconception %s: seen_in should be one of the checks that it loses",
                           entry->id, misconception->mutant);
    for (const Misconception *other = entry->misconceptions; other < misconception; other++)
        if (!strcmp(other->mutant, misconception->mutant))
            return text_format("%s: two misconceptions are called %s", entry->id, other->mutant);
    return NULL;
}

static char *check_files(const Manifest *manifest, const Entry *entry)
{
    for (const Entry *other = manifest->entries; other <= entry; other++)
        for (int i = 0; i < entry->file_count; i++)
            for (int j = 0; j < other->file_count && (other != entry || j < i); j++)
                if (!strcmp(entry->files[i], other->files[j]))
                    return text_format("%s: %s is %s's file, too; base names are unique in the course",
                                       entry->id, entry->files[i], other->id);
    const char *ending = strrchr(entry->files[0], '.');
    bool text = !strcmp(ending, ".txt");
    if (text != (entry->kind == EXERCISE_MEASURE))
        return text_format("%s: the first file is the one to open: .txt in a measure exercise, else source",
                           entry->id);
    return NULL;
}

static char *check_entry(const Manifest *manifest, const Entry *entry)
{
    if (strncmp(entry->id, entry->folder, 2))
        return text_format("%s: stands in folder %s of another chapter", entry->id, entry->folder);
    if (entry > manifest->entries &&
        (strncmp(entry[-1].id, entry->id, 2) > 0 ||
         (!strncmp(entry[-1].id, entry->id, 2) && atoi(entry[-1].id + 3) >= atoi(entry->id + 3))))
        return text_format("%s: comes after %s; ids ascend", entry->id, entry[-1].id);
    for (int i = 0; i < entry->builds_on_count; i++) {
        const Entry *other = manifest_find(manifest, entry->builds_on[i]);
        if (!other || other >= entry)
            return text_format("%s: builds on %s, which is no earlier exercise", entry->id,
                               entry->builds_on[i]);
    }
    char *error = check_files(manifest, entry);
    for (int i = 0; i < entry->check_count && !error; i++)
        error = check_check(entry, &entry->checks[i]);
    for (int i = 0; i < entry->misconception_count && !error; i++)
        error = check_misconception(entry, &entry->misconceptions[i]);
    return error;
}

static json_t *load_json(const char *file, char **error)
{
    json_error_t where;
    json_t *json = json_load_file(file, JSON_REJECT_DUPLICATES, &where);
    *error = json ? NULL : text_format("%s:%d: %s", file, where.line, where.text);
    return json;
}

char *manifest_load(const char *file, const char *schema_file, Manifest *manifest)
{
    *manifest = (Manifest){0};
    char *error = NULL;
    json_t *schema = load_json(schema_file, &error);
    manifest->root = error ? NULL : load_json(file, &error);
    char *inner = error ? NULL : schema_error(schema, manifest->root, "");
    json_decref(schema);
    json_t *list = error || inner ? NULL : json_object_get(manifest->root, "exercises");
    manifest->entries = memory_new(json_array_size(list), sizeof *manifest->entries, "exercises");
    for (; manifest->count < (int)json_array_size(list); manifest->count++)
        manifest->entries[manifest->count] = entry_of(json_array_get(list, (size_t)manifest->count));
    for (int i = 0; i < manifest->count && !inner; i++)
        inner = check_entry(manifest, &manifest->entries[i]);
    if (inner)
        error = text_format("%s: %s", file, inner);
    free(inner);
    return error;
}

Manifest manifest_open(const char *file, const char *schema_file)
{
    Manifest manifest;
    char *error = manifest_load(file, schema_file, &manifest);
    if (error)
        fail_work("%s", error);
    return manifest;
}

void manifest_close(Manifest *manifest)
{
    for (Entry *entry = manifest->entries; entry < manifest->entries + manifest->count; entry++) {
        for (int i = 0; i < entry->misconception_count; i++)
            free(entry->misconceptions[i].loses);
        free(entry->misconceptions);
        free(entry->checks);
        free(entry->read);
        free(entry->files);
        free(entry->builds_on);
        free(entry->program);
    }
    free(manifest->entries);
    json_decref(manifest->root);
    *manifest = (Manifest){0};
}

const Entry *manifest_find(const Manifest *manifest, const char *id)
{
    for (int i = 0; i < manifest->count; i++)
        if (!strcmp(manifest->entries[i].id, id))
            return &manifest->entries[i];
    return NULL;
}

const Check *entry_check(const Entry *entry, const char *name)
{
    for (int i = 0; i < entry->check_count; i++)
        if (!strcmp(entry->checks[i].name, name))
            return &entry->checks[i];
    return NULL;
}

const char *entry_kind_name(const Entry *entry)
{
    return (const char *[]){"practice", "graded", "measure"}[entry->kind];
}

double entry_points(const Entry *entry)
{
    double points = 0;
    for (int i = 0; i < entry->check_count; i++)
        points += entry->checks[i].points;
    return points;
}

size_t check_values(const Check *check)
{
    const Shape *shape = &check->shape;
    return (size_t)shape->size[0] * (size_t)shape->size[1] * (size_t)shape->size[2] * (size_t)shape->channels;
}
