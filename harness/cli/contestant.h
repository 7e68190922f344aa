/* What `bench --against` times: a cell in this process, or the same cell of another program, which
 * is started anew for every lap and says its own time and work as JSON. */
#ifndef BEAMWORK_CONTESTANT_H
#define BEAMWORK_CONTESTANT_H

#include <jansson.h>

#include "harness/cli/command.h"
#include "harness/records/schema.h"
#include "harness/study/against.h"

enum { CONTESTANT_ARGUMENTS = 12 + 2 * CASE_MAX_PARAMETERS };

typedef struct contestant {
    char name[FORMULATION_KEY + 512];
    cell_request request;
    const char *program;                        /* NULL: in this process */
    const char *argument[CONTESTANT_ARGUMENTS]; /* of the program, NULL-terminated */
    char elements[16];                          /* one of them */
    int repeats;                                /* in one lap */
    double plant;                               /* share of its time added to every lap */
    int counts;
    const schema_field *counted[SCHEMA_MOST_FIELDS]; /* size and work: what a cell counts */
    double count[SCHEMA_MOST_FIELDS];
} contestant;

/* A cell of the scene, which it keeps a pointer to. */
void contestant_here(contestant *, const command_request *r, const scene *s,
                     const formulation *chosen, int elements);
/* The one cell of the request, by another program. It points to itself: it is not copied. */
void contestant_elsewhere(contestant *, const command_request *r, const char *program);
/* In alternation, on one processor, for a few seconds; counts what the cells count. */
status contestant_compete(contestant *a, contestant *b, against *out, fault *f);
/* Both times, which is faster, and how their work differs; the same as JSON, which the caller owns.
 */
void contestant_show(const contestant *a, const contestant *b, const against *v);
json_t *contestant_json(const contestant *a, const contestant *b, const against *v);
/* A line for each of them whose times rank nothing, and why. */
void contestant_unranked(const contestant *a, const contestant *b);

#endif
