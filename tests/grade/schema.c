// schema: see schema.h. Each keyword is one function; NULL means that it has nothing to object to.
#include "schema.h"
#include "base.h"

#include <regex.h>
#include <stdlib.h>
#include <string.h>

static char *check_type(json_t *rule, json_t *value, const char *place)
{
    const char *type = json_string_value(rule);
    bool fits = (!strcmp(type, "object") && json_is_object(value)) ||
                (!strcmp(type, "array") && json_is_array(value)) ||
                (!strcmp(type, "string") && json_is_string(value)) ||
                (!strcmp(type, "integer") && json_is_integer(value)) ||
                (!strcmp(type, "number") && json_is_number(value)) ||
                (!strcmp(type, "boolean") && json_is_boolean(value));
    return fits ? NULL : text_format("%s: should be of type %s", place, type);
}

static char *check_enum(json_t *rule, json_t *value, const char *place)
{
    size_t i;
    json_t *one;
    json_array_foreach(rule, i, one)
    {
        if (json_equal(one, value))
            return NULL;
    }
    char *list = json_dumps(rule, JSON_COMPACT), *error = text_format("%s: should be one of %s", place, list);
    free(list);
    return error;
}

static char *check_required(json_t *rule, json_t *value, const char *place)
{
    size_t i;
    json_t *name;
    json_array_foreach(rule, i, name)
    {
        if (json_is_object(value) && !json_object_get(value, json_string_value(name)))
            return text_format("%s: has no \"%s\"", place, json_string_value(name));
    }
    return NULL;
}

static char *check_properties(json_t *rule, json_t *value, const char *place)
{
    const char *name;
    json_t *inner;
    json_object_foreach(value, name, inner)
    {
        json_t *schema = json_object_get(rule, name);
        char *where = text_format("%s%s%s", place, *place ? "." : "", name);
        char *error = schema ? schema_error(schema, inner, where) : NULL;
        free(where);
        if (error)
            return error;
    }
    return NULL;
}

// Only `false` is understood: then what `properties` does not name is wrong.
static char *check_additional(json_t *schema, json_t *value, const char *place)
{
    json_t *properties = json_object_get(schema, "properties"), *inner;
    const char *name;
    json_object_foreach(value, name, inner)
    {
        if (!json_object_get(properties, name))
            return text_format("%s: \"%s\" is not known here", place, name);
    }
    return NULL;
}

static char *check_items(json_t *rule, json_t *value, const char *place)
{
    size_t i;
    json_t *item;
    json_array_foreach(value, i, item)
    {
        char *where = text_format("%s[%zu]", place, i), *error = schema_error(rule, item, where);
        free(where);
        if (error)
            return error;
    }
    return NULL;
}

static char *check_pattern(json_t *rule, json_t *value, const char *place)
{
    regex_t pattern;
    if (regcomp(&pattern, json_string_value(rule), REG_EXTENDED | REG_NOSUB))
        return text_format("%s: the schema's pattern '%s' is none", place, json_string_value(rule));
    bool fits = !json_is_string(value) || !regexec(&pattern, json_string_value(value), 0, NULL, 0);
    regfree(&pattern);
    return fits ? NULL
                : text_format("%s: \"%s\" should look like %s", place, json_string_value(value),
                              json_string_value(rule));
}

// What minItems, maxItems, minLength, maxLength, minimum and maximum measure, in what they measure it in.
static char *check_limit(const char *keyword, json_t *rule, json_t *value, const char *place)
{
    const char *what = strstr(keyword, "Items") ? " items" : strstr(keyword, "Length") ? " bytes" : "";
    bool applies = *what == '\0'    ? json_is_number(value)
                   : what[1] == 'i' ? json_is_array(value)
                                    : json_is_string(value);
    double got = *what == '\0'    ? json_number_value(value)
                 : what[1] == 'i' ? (double)json_array_size(value)
                                  : (double)json_string_length(value);
    double limit = json_number_value(rule);
    bool least = !strncmp(keyword, "min", 3);
    if (!applies || (least ? got >= limit : got <= limit))
        return NULL;
    return text_format("%s: %g%s; should be at %s %g", place, got, what, least ? "least" : "most", limit);
}

char *schema_error(json_t *schema, json_t *value, const char *place)
{
    const char *keyword;
    json_t *rule;
    char *error = NULL;
    // The type first: the other keywords then meet what they are made for.
    if ((rule = json_object_get(schema, "type")) && (error = check_type(rule, value, place)))
        return error;
    json_object_foreach(schema, keyword, rule)
    {
        if (!strcmp(keyword, "enum"))
            error = check_enum(rule, value, place);
        else if (!strcmp(keyword, "required"))
            error = check_required(rule, value, place);
        else if (!strcmp(keyword, "properties"))
            error = check_properties(rule, value, place);
        else if (!strcmp(keyword, "additionalProperties") && json_is_false(rule))
            error = check_additional(schema, value, place);
        else if (!strcmp(keyword, "items"))
            error = check_items(rule, value, place);
        else if (!strcmp(keyword, "pattern"))
            error = check_pattern(rule, value, place);
        else if (!strncmp(keyword, "min", 3) || !strncmp(keyword, "max", 3))
            error = check_limit(keyword, rule, value, place);
        else if (strcmp(keyword, "type") && strcmp(keyword, "title") && strcmp(keyword, "description"))
            error = text_format("%s: the schema's keyword \"%s\" is not known", place, keyword);
        if (error)
            return error;
    }
    return NULL;
}
