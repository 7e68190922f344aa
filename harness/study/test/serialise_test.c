/* A cell's result on its way between processes: everything arrives as it was sent, bit for bit, and
 * nothing that is cut short is believed. */
#include <gsl/gsl_test.h>
#include <stdio.h>
#include <stdlib.h>

#include "harness/study/study.h"
#include "harness/study/test/random_cell.h"
#include "harness/study/test/same_cell.h"

static void round_trips(dice *d)
{
    enum { CELLS = 200 };
    cell_result sent[CELLS];
    FILE *file = tmpfile();
    int unwritten = 0, unread = 0;
    difference first = {NULL};
    if (file != NULL)
        for (int i = 0; i < CELLS; i++) {
            sent[i] = random_cell(d);
            unwritten += serialise_write(file, &sent[i]) != 0;
        }
    rewind(file);
    for (int i = 0; i < CELLS; i++) { /* one behind the other, as a worker sends them */
        cell_result got;
        unread += serialise_read(file, &got) != 0;
        const difference here = compare_cells(&sent[i], &got);
        if (first.name == NULL)
            first = here;
        cell_result_free(&got);
        cell_result_free(&sent[i]);
    }
    gsl_test_int(unwritten, 0, "cells that were not sent");
    gsl_test_int(unread, 0, "cells that did not arrive");
    gsl_test(first.name != NULL, "what arrives is what was sent (%s)",
             first.name != NULL ? first.name : "all");
    gsl_test_int(fgetc(file), EOF, "and nothing more");
    fclose(file);
}

/* The least there is: a cell that failed before it had anything. */
static void empty_cell(void)
{
    const cell_result sent = {.solve = {.status = STATUS_SINGULAR, .reason = "nothing"}};
    cell_result got;
    FILE *file = tmpfile();
    gsl_test(file == NULL || serialise_write(file, &sent) != 0, "sent");
    rewind(file);
    gsl_test(serialise_read(file, &got) != 0 || compare_cells(&sent, &got).name != NULL,
             "an empty cell arrives");
    cell_result_free(&got);
    fclose(file);
}

static int is_empty(const cell_result *c)
{
    const solve_result *s = &c->solve;
    return c->left_out == NULL && s->quantity == NULL && s->step == NULL && s->iteration == NULL &&
           s->event == NULL && s->matrices == NULL && s->shapes.first == NULL &&
           s->shapes.state == NULL && s->shapes.point == NULL && s->shapes.node == NULL;
}

/* Every truncation is noticed and leaves nothing behind, whichever part comes last. */
static void truncated(dice *d, int pictured)
{
    cell_result sent = random_cell(d), got;
    if (!pictured)
        shapes_free(&sent.solve.shapes);
    char *bytes = NULL;
    size_t size = 0;
    FILE *file = open_memstream(&bytes, &size);
    gsl_test(file == NULL || serialise_write(file, &sent) != 0 || fclose(file) != 0, "written");
    int accepted = 0, left = 0;
    for (size_t cut = 0; cut < size; cut++) {
        file = cut > 0 ? fmemopen(bytes, cut, "rb") : fopen("/dev/null", "rb");
        accepted += serialise_read(file, &got) == 0;
        left += !is_empty(&got);
        fclose(file);
    }
    file = fmemopen(bytes, size, "rb");
    gsl_test(serialise_read(file, &got) != 0, "the whole is read");
    fclose(file);
    cell_result_free(&got);
    cell_result_free(&sent);
    free(bytes);
    gsl_test(size < 1000, "%ld bytes", (long)size);
    gsl_test_int(accepted, 0, "truncated cells that were accepted");
    gsl_test_int(left, 0, "truncated cells that left something");
}

int main(void)
{
    dice d = {88172645463325252ull};
    random_cell_complete();
    round_trips(&d);
    empty_cell();
    for (int i = 0; i < 6; i++)
        truncated(&d, i % 2);
    return gsl_test_summary();
}
