#include "harness/newton/identity.h"

#include <string.h>

#include "harness/model/model.h"

identity identity_begin(void)
{
    return (identity){{14695981039346656037ull, 0x9e3779b97f4a7c15ull}};
}

/* FNV-1a, and beside it a product of another kind. */
void identity_add(identity *out, const void *bytes, size_t size)
{
    const unsigned char *at = bytes;
    for (size_t i = 0; i < size; i++) {
        out->part[0] = (out->part[0] ^ at[i]) * 1099511628211ull;
        out->part[1] = (out->part[1] + at[i] + 1) * 0xd6e8feb86659fd93ull;
        out->part[1] ^= out->part[1] >> 32;
    }
}

static void add_number(identity *out, long number)
{
    identity_add(out, &number, sizeof number);
}

/* All of a type but its words, and what has done its work when the data are there. */
static void add_type(identity *out, const element_type *type)
{
    element_type t;
    memcpy(&t, type, sizeof t);
    t.name = t.summary = t.source = t.family = t.lacks_by = t.own_theory = NULL;
    t.offers = t.lacks = t.shear_theories = 0;
    t.data_size = NULL;
    t.prepare = NULL;
    t.order = NULL;
    t.judged = NULL;
    memset(t.options, 0, sizeof t.options);
    identity_add(out, &t, sizeof t);
}

static void add_elements(identity *out, const model *m)
{
    for (int i = 0; i < model_kinds(m); i++) {
        identity_add(out, &model_kind(m, i)->length, sizeof model_kind(m, i)->length);
        identity_add(out, model_kind(m, i)->data, model_kind(m, i)->data_size);
    }
    for (int i = 0; i < model_elements(m); i++) {
        add_number(out, model_element(m, i)->kind);
        identity_add(out, model_element(m, i)->warp, sizeof model_element(m, i)->warp);
        identity_add(out, model_element(m, i)->triad, (size_t)model_nodes(m) * sizeof(mesh_triad));
    }
}

int identity_add_model(identity *out, const model *m)
{
    const char *const *line;
    const int lines = model_left_out(m, &line);
    if (model_type(m)->trouble != NULL)
        return 0;
    add_type(out, model_type(m));
    add_number(out, model_features(m));
    add_number(out, model_features(m) & model_type(m)->offers);
    add_number(out, model_keeps_all(m));
    add_number(out, model_elements(m));
    add_number(out, model_unknowns(m));
    add_number(out, model_driven(m));
    for (int i = 0; i < ELEMENT_MAX_OPTIONS; i++)
        identity_add(out, &model_options(m)[i], sizeof model_options(m)[i]);
    for (int i = 0; i < lines; i++)
        identity_add(out, line[i], strlen(line[i]) + 1);
    add_elements(out, m);
    return 1;
}
