#include "cases/format/packed.h"

#include "cases/format/build.h"
#include "cases/format/scene_file_impl.h"

/* The tree, owned by the arena; NULL out of memory. */
static const document_node *unpack(const scene_packed *p, arena *a)
{
    const size_t nodes = (size_t)p->nodes;
    document_node *out = arena_take(a, nodes * sizeof *out);
    document_node **at = arena_take(a, nodes * sizeof *at);
    for (int i = 0; out != NULL && at != NULL && i < p->nodes; i++) {
        const document_packed *n = &p->node[i];
        const document_kind kind = (document_kind)n->kind;
        at[i] = &out[i];
        out[i] = (document_node){kind, n->line, n->column, n->inset, NULL, n->count, NULL, NULL};
        if (kind == DOCUMENT_TEXT)
            out[i].text = p->texts + n->first;
        else
            out[i].item = at + n->first + (kind == DOCUMENT_MAP ? n->count : 0);
        if (kind == DOCUMENT_MAP)
            out[i].key = at + n->first;
    }
    return at != NULL ? out : NULL;
}

status scene_packed_build(const void *context, const double value[], scene *s, fault *f)
{
    const scene_packed *p = context;
    arena a = {0};
    mistakes m = {.file = p->file};
    const document_node *root = unpack(p, &a);
    if (root != NULL)
        build_scene(root, parameter_table_names(p->parameters, value, &a), BUILD_BY_SUPPORTS, &a,
                    &m, s);
    m.out_of_memory |= a.failed;
    arena_free(&a);
    /* of a case of the program it says more by itself than with the place in a file */
    return m.count > 0 && !m.out_of_memory ? fault_set(f, STATUS_REFUSED, "%s", m.list[0].text)
                                           : mistakes_status(&m, f);
}
