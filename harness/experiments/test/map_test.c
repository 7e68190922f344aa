/* What stands in the fields of a sweep's map: one of each kind. */
#include <gsl/gsl_test.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "harness/experiments/experiments_impl.h"

enum { PLACES = 8 };

static const parameter_type map_table[] = {{"a", "m", 1, -100, 100, NULL, ""}, {0}};
static const case_type map_box = {.name = "box", .parameters = {map_table}};

/* With a truth at some points, and elsewhere with none. */
static const struct {
    tally_place place;
    const char *mixed, *alike;
} field[PLACES] = {
    {{.points = 0}, ".", "."},
    {{.points = 2, .other = 2}, "o", "o"},
    {{.points = 2}, "?", "?"},
    {{.points = 2, .asked = 2, .never = 1, .proven = 1}, "-*", "-"},
    {{.points = 2, .asked = 2, .never = 1}, "-", "-"},
    {{.points = 2, .asked = 2, .proven = 1, .least = 4}, "4*", "4"},
    {{.points = 2, .asked = 2, .least = 8}, "8", "8"},
    {{.points = 2, .asked = 1, .proven = 1, .least = 4}, "4*?", "4?"},
};

static void map_map_is(int mixed)
{
    parameter_ranges r = {.request = {.type = &map_box, .tolerance = 0.01},
                          .formulations = 1,
                          .meshes = 2,
                          .mesh = {4, 8},
                          .quantities = 1,
                          .points_in_batch = PLACES,
                          .batches = 1};
    tally t;
    fault f = {""};
    char *text = NULL;
    size_t size = 0;
    axis_read(&map_box, "a=0..7/7", &r.axis[0], NULL);
    design_make(DESIGN_GRID, 1, r.axis, 0, 0, &r.design, NULL);
    snprintf(r.formulation[0].key, sizeof r.formulation[0].key, "beam");
    gsl_test(tally_alloc(&r, &t, &f) != STATUS_OK, "%s", f.text);
    gsl_test_int(t.columns, PLACES, "columns");
    for (int q = 0; q < 2; q++) {
        t.series[q].asked = 11;
        t.series[q].proven = mixed ? 3 : 11;
        for (int i = 0; i < PLACES; i++)
            t.map[q * PLACES + i] = field[i].place;
    }
    FILE *to = open_memstream(&text, &size);
    ranges_table_map(to, &t, 1);
    fclose(to);
    int lines = 0;
    for (const char *at = text; (at = strstr(at, "\n  beam ")) != NULL; lines++) {
        char word[16];
        at += strlen("\n  beam ");
        for (int i = 0; i < PLACES; i++) {
            int length = 0;
            sscanf(at, "%15s%n", word, &length);
            at += length;
            gsl_test_str(word, mixed ? field[i].mixed : field[i].alike, "field %d, mixed: %d", i,
                         mixed);
        }
    }
    gsl_test(lines == 0, "a map is drawn: %s", text);
    free(text);
    tally_free(&t);
}

int main(void)
{
    map_map_is(0);
    map_map_is(1);
    return gsl_test_summary();
}
