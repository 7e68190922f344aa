#include "harness/study/scene_truths.h"

#include <math.h>
#include <string.h>

#include "elements/shared/parameter.h"

typedef struct taker {
    const case_type *type;
    truths *truths;
} taker;

static int same_point(const case_type *type, const double a[], const double b[])
{
    for (int i = 0; i < parameter_count(type->parameters); i++)
        if (a[i] != b[i])
            return 0;
    return 1;
}

static int is_same(const truth *row, const scene_truth *one)
{
    return strcmp(row->quantity, one->quantity) == 0 && strcmp(row->kind, one->kind) == 0 &&
           strcmp(row->formulation, one->formulation) == 0 &&
           strcmp(row->theory, one->theory) == 0 && strcmp(row->model, one->model) == 0 &&
           (isnan(one->at) ? !row->on_curve : row->at == one->at);
}

static int is_known_row(const truths *t, const case_type *type, const scene_truth *one)
{
    for (int i = 0; i < t->rows; i++)
        if (t->row[i].type == type && is_same(&t->row[i], one) &&
            same_point(type, t->row[i].parameter, one->parameter))
            return 1;
    return 0;
}

static status add_row(truths *t, const case_type *type, const scene_truth *one, fault *f)
{
    truth *row = truths_add(t, f);
    if (row == NULL)
        return STATUS_FAULT;
    row->type = type;
    memcpy(row->parameter, one->parameter, sizeof row->parameter);
    row->value = one->value;
    row->uncertainty = one->uncertainty;
    row->on_curve = !isnan(one->at);
    row->at = one->at;
    char **const to[] = {&row->formulation, &row->theory, &row->quantity,   &row->unit,
                         &row->kind,        &row->model,  &row->convention, &row->source};
    const char *const from[] = {one->formulation, one->theory, one->quantity,   one->unit,
                                one->kind,        one->model,  one->convention, one->source};
    for (size_t i = 0; i < sizeof to / sizeof to[0]; i++)
        if ((*to[i] = strdup(from[i])) == NULL)
            return fault_set(f, STATUS_FAULT, "out of memory for truths");
    return STATUS_OK;
}

static status take(void *to, const scene_truth *one, fault *f)
{
    const taker *t = to;
    return is_known_row(t->truths, t->type, one) ? STATUS_OK : add_row(t->truths, t->type, one, f);
}

status scene_truths_add(const scene_file *file, const double value[], truths *t, fault *f)
{
    taker to = {scene_file_case(file), t};
    return scene_file_truths(file, value, take, &to, f);
}

status scene_truths_add_all(const scene_file *file, truths *t, fault *f)
{
    taker to = {scene_file_case(file), t};
    return scene_file_truths_all(file, take, &to, f);
}
