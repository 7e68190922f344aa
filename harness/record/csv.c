#include "harness/record/csv.h"

#include "harness/record/csv_record.h"
#include "harness/schema/gather.h"

void csv_solution(FILE *to, const sweep *s)
{
    const gathering g = {s, NULL, NULL};
    subjects list = {0};
    csv_part row = {&record_quantity, gather_cell(&g, 0, 0)};
    gather_mesh(&g, &record_quantity, 0, 0, &list);
    csv_head(to, 1, &row);
    for (int i = 0; i < list.count; i++) {
        row.s = list.row[i];
        csv_line(to, 1, &row);
    }
    subjects_free(&list);
}

void csv_convergence(FILE *to, const sweep *s, const truths *t)
{
    enum { QUANTITY, CELL, PARTS };
    const gathering g = {s, NULL, t};
    csv_part row[PARTS] = {{.type = &record_quantity}, {.type = &record_cell}};
    csv_head(to, PARTS, row);
    for (int i = 0; i < s->seriess; i++)
        if (s->series[i].missing[0] == '\0')
            for (int k = 0; k < s->series[i].meshes; k++) {
                subjects list = {0};
                gather_mesh(&g, &record_quantity, i, k, &list);
                row[CELL].s = gather_cell(&g, i, k);
                for (int q = 0; q < list.count; q++) {
                    row[QUANTITY].s = list.row[q];
                    csv_line(to, PARTS, row);
                }
                subjects_free(&list);
            }
}

void csv_timing(FILE *to, const sweep *s, const judgement *j)
{
    enum { TIMING, QUANTITY, CELL, PARTS };
    const gathering g = {s, j, NULL};
    csv_part row[PARTS] = {
        {.type = &record_timing}, {.type = &record_quantity}, {.type = &record_cell}};
    csv_head(to, PARTS, row);
    for (int i = 0; i < s->seriess; i++)
        if (s->series[i].missing[0] == '\0')
            for (int k = 0; k < s->series[i].meshes; k++) {
                subjects list = {0};
                gather_mesh(&g, &record_quantity, i, k, &list);
                row[TIMING].s = row[CELL].s = gather_cell(&g, i, k);
                row[TIMING].s.record = &s->series[i].timing[k];
                for (int q = 0; q < list.count; q++) {
                    row[QUANTITY].s = list.row[q];
                    if (list.row[q].truth != NULL)
                        csv_line(to, PARTS, row);
                }
                subjects_free(&list);
            }
}
