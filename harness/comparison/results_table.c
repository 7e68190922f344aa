/* The short table of a run: one row per cell, small enough to be committed and read in a diff. */
#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "harness/comparison/results.h"

static const char head[] = "cell,elements,status,iterations,evaluations,factorisations,judged,decades,error,quantity";
enum { FIELDS = 10, LONGEST_NAME = 1200, LONGEST_LINE = 2000 };

void results_write_table(FILE *to, const results *r)
{
    fprintf(to, "%s\n", head);
    for (int i = 0; i < r->cells; i++) {
        const result_cell *c = &r->cell[i];
        fprintf(to, "\"%s\",%d,%s", c->name, c->elements, c->status);
        for (int k = 0; k < RESULTS_WORKS; k++)
            fprintf(to, ",%ld", c->work[k]);
        fprintf(to, ",%d,%.6f,%.6g,%s\n", c->summary.judged, c->summary.decades, c->summary.worst, c->summary.quantity);
    }
}

/* Splits a line into its fields, of which the first may be quoted; 0: there are not FIELDS of them. */
static int split(char *line, char *field[FIELDS])
{
    char *at = line;
    if (*at == '"') {
        field[0] = at + 1;
        at = strchr(at + 1, '"');
        if (at == NULL)
            return 0;
        *at++ = '\0';
    } else {
        field[0] = at;
        at += strcspn(at, ",");
    }
    for (int i = 1; i < FIELDS; i++) {
        if (*at != ',')
            return 0;
        *at++ = '\0';
        field[i] = at;
        at += strcspn(at, ",");
    }
    return *at == '\0';
}

static int whole(const char *text, long most, long *out)
{
    char *end;
    errno = 0;
    *out = strtol(text, &end, 10);
    return end != text && *end == '\0' && errno == 0 && *out >= 0 && *out <= most;
}

static int number(const char *text, double *out)
{
    char *end;
    *out = strtod(text, &end);
    return end != text && *end == '\0' && isfinite(*out);
}

static int take(char *field[FIELDS], result_cell *cell)
{
    long elements = 0, judged = 0;
    result_summary *s = &cell->summary;
    int good = strlen(field[0]) < LONGEST_NAME && strchr(field[0], '"') == NULL && strlen(field[2]) < sizeof cell->status &&
               strlen(field[9]) < sizeof s->quantity && whole(field[1], 10000000, &elements) && whole(field[6], 1000000, &judged) &&
               number(field[7], &s->decades) && fabs(s->decades) < 1e9 && number(field[8], &s->worst) && s->worst >= 0;
    for (int k = 0; k < RESULTS_WORKS; k++)
        good = good && whole(field[3 + k], 1000000000000000L, &cell->work[k]);
    if (!good)
        return 0;
    cell->elements = (int)elements;
    s->judged = (int)judged;
    snprintf(cell->status, sizeof cell->status, "%s", field[2]);
    snprintf(s->quantity, sizeof s->quantity, "%s", field[9]);
    cell->name = strdup(field[0]);
    return cell->name != NULL;
}

status results_read_table(const char *path, FILE *from, results *out, fault *f)
{
    char line[LONGEST_LINE], *field[FIELDS];
    out->whole = 0;
    for (int row = 1; fgets(line, sizeof line, from) != NULL; row++) {
        const size_t length = strcspn(line, "\n");
        const int ended = line[length] == '\n';
        line[length] = '\0';
        if (row == 1 && (!ended || strcmp(line, head) != 0))
            break;
        if (row == 1) {
            out->whole = -1; /* it is one of ours */
            continue;
        }
        result_cell *cell = ended ? results_add(out) : NULL;
        if (ended && cell == NULL)
            return fault_set(f, STATUS_FAULT, "out of memory for results");
        if (cell == NULL || !split(line, field) || !take(field, cell))
            return fault_set(f, STATUS_FAULT,
                             "%.120s:%d: the row is damaged or cut short; write the table again with 'beamwork compare -o'", path,
                             row);
    }
    if (out->whole == 0)
        return fault_set(f, STATUS_FAULT,
                         "%.120s: neither results of 'beamwork verify -o' (HDF5) nor a table of 'beamwork compare -o'", path);
    out->whole = 0;
    return ferror(from) ? fault_set(f, STATUS_FAULT, "%.120s: cannot be read", path) : STATUS_OK;
}
