/* Entries of a map in YAML: unknown keys, texts, numbers; mistakes with their places. */
#ifndef BEAMWORK_MAP_KEYS_H
#define BEAMWORK_MAP_KEYS_H

#include "cases/format/document.h"

/* A mistake for every key that is not in the list, which ends with NULL. */
void map_keys_check(const document_node *map, const char *const known[], mistakes *m);
/* The text of an entry; `otherwise` where there is none. */
const char *map_keys_text(mistakes *m, const document_node *map, const char *key,
                          const char *otherwise);
double map_keys_number(mistakes *m, const document_node *map, const char *key, double otherwise);
/* A whole number, zero or above. */
int map_keys_count(mistakes *m, const document_node *map, const char *key, int otherwise);

#endif
