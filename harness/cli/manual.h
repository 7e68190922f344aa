/* The pages of the manual, from the tables that the program itself works with. */
#ifndef BEAMWORK_MANUAL_H
#define BEAMWORK_MANUAL_H

#include <stdio.h>

#include "harness/cli/options.h"
#include "harness/records/records.h"

/* A line of the program's help. */
typedef struct manual_row {
    const char *name, *text;
} manual_row;

/* What the program says of itself. Rows end with a name of NULL. */
typedef struct manual_program {
    const char *summary, *question; /* one line each */
    const verb *const *verbs;       /* all, and NULL */
    const manual_row *examples, *statuses;
    const char *of_compare; /* exit status of the verb that is as diff */
} manual_program;

/* What a result file consists of. */
typedef struct results_record {
    char place[64]; /* before the name of its table */
    const record_type *type;
} results_record;

/* Number i, of the verbs too, or a type of NULL behind the last one. */
results_record results_record_at(const verb *const *verbs, int i);
extern const char *const results_about[]; /* paragraphs, ending with NULL */
/* "text *", "int", ...; the unit as it is shown; what it is, with its words. */
typedef struct results_field {
    const char *kind, *unit;
    char text[1000];
} results_field;
results_field results_field_of(const schema_field *f);

/* beamwork(1). */
void manual_write_program(FILE *to, const manual_program *p);
/* beamwork-VERB(1). */
void manual_write_verb(FILE *to, const verb *v);
/* beamwork-scene-file(5): what may stand in a scene file. */
void manual_write_scene(FILE *to);
/* beamwork-results(5): what a result file consists of. */
void manual_write_results(FILE *to, const verb *const *verbs);

/* Pages as mdoc(7): what a text means stands in macros, what it says in lines that no formatter
 * takes for one. */
/* Running text: lines of its words, each as it is written: hyphens, quotes and '^' can be copied.
 */
void roff_text(FILE *to, const char *text);
/* Behind a macro: one argument, a blank before it, whatever it says. */
void roff_argument(FILE *to, const char *text);
/* A line inside .Bd -literal. */
void roff_literal(FILE *to, const char *line, size_t length);
/* The head of a page: ".Dd" to ".Nd". name: "beamwork-solve"; about: one line. */
void roff_page(FILE *to, const char *name, int chapter, const char *about);
/* "See also": names with their sections, "beamwork 1 beamwork-scene 5". */
typedef struct roff_reference {
    const char *name;
    int section;
} roff_reference;
void roff_see(FILE *to, const roff_reference list[], int count);

#endif
