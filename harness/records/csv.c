#include "harness/records/csv.h"

#include "harness/records/csv_record.h"
#include "harness/records/gather.h"

/* A line for a value; for a curve one for each of its points, and one that says why it ends early.
 */
static void write_lines(FILE *to, int parts, csv_part row[], int value)
{
    const subject s = row[value].s;
    const quantity_result *r = s.record;
    quantity_result one = *r;
    one.status = STATUS_OK;
    one.reason[0] = '\0';
    row[value].s.record = &one;
    row[value].s.truth = row[value].s.model_truth = NULL;
    for (int i = 0; i < r->curve.points; i++) {
        one.x = r->curve.x[i];
        one.value = r->curve.value[i];
        csv_record_line(to, parts, row);
    }
    row[value].s = s;
    if (r->curve.points == 0 || r->status != STATUS_OK)
        csv_record_line(to, parts, row);
}

void csv_solution(FILE *to, const sweep *s)
{
    const gathering g = {s, NULL, NULL};
    subjects list = {0};
    const subject cell = gather_cell(&g, 0, 0);
    csv_part row[] = {{&record_quantity, cell}, {&record_omission, cell}};
    gather_mesh(&g, &record_quantity, 0, 0, &list);
    csv_record_head(to, 2, row);
    for (int i = 0; i < list.count; i++) {
        row[0].s = list.row[i];
        write_lines(to, 2, row, 0);
    }
    gather_free(&list);
}

/* A line for each quantity of each mesh, or for those with a truth; the parts are of the quantity
 * and its cell. */
static void list_meshes(FILE *to, const gathering *g, int with_truth, int parts, csv_part row[])
{
    const sweep *s = g->sweep;
    csv_record_head(to, parts, row);
    for (int i = 0; i < s->seriess; i++)
        if (s->series[i].missing[0] == '\0')
            for (int k = 0; k < s->series[i].meshes; k++) {
                subjects list = {0};
                gather_mesh(g, &record_quantity, i, k, &list);
                for (int q = 0; q < list.count; q++) {
                    for (int part = 0; part < parts; part++) {
                        const record_type *type = row[part].type;
                        row[part].s = type == &record_quantity ? list.row[q] : gather_cell(g, i, k);
                        if (type == &record_timing)
                            row[part].s.record = &s->series[i].timing[k];
                    }
                    if (!with_truth)
                        write_lines(to, parts, row, 0);
                    else if (list.row[q].truth != NULL)
                        csv_record_line(to, parts, row);
                }
                gather_free(&list);
            }
}

void csv_convergence(FILE *to, const sweep *s, const truths *t)
{
    csv_part row[] = {{.type = &record_quantity}, {.type = &record_cell}};
    list_meshes(to, &(gathering){s, NULL, t}, 0, 2, row);
}

void csv_timing(FILE *to, const sweep *s, const judgement *j)
{
    csv_part row[] = {{.type = &record_timing}, {.type = &record_quantity}, {.type = &record_cell}};
    list_meshes(to, &(gathering){s, j, NULL}, 1, 3, row);
}
