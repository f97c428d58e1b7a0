// schema: does a JSON value follow a JSON Schema? The part of JSON Schema that manifest.schema.json needs: type, enum, required, properties,
// additionalProperties (false), items, minItems, maxItems, minLength, maxLength, pattern (POSIX extended), minimum, maximum.
#ifndef SCHEMA_H
#define SCHEMA_H

#include <jansson.h>

// NULL where `value` follows `schema`, else (free it) "PLACE: what is wrong", PLACE such as exercises[0].checks[2].points. A keyword of the schema
// that is not in the list above is an error too: nothing is skipped silently. title and description say nothing about a value.
char *schema_error(json_t *schema, json_t *value, const char *place);

#endif
