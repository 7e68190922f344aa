/* Writes a scene file of cases/ as C: the case as a constant, its parameters as a table, and its
 * document as a list without pointers (cases/format/format.h).
 * usage: pack_case FILE.yaml >FILE.c   The file must be a scene at its defaults. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cases/format/format.h"

typedef struct packing {
    const document_node **node;
    int *first;
    int nodes, characters;
} packing;

static int count_of(const document_node *n)
{
    int count = 1;
    for (int i = 0; i < n->count; i++)
        count += count_of(n->item[i]) + (n->key != NULL);
    return count;
}

static void place(packing *p)
{
    for (int i = 0; i < p->nodes; i++) {
        const document_node *n = p->node[i];
        if (n->kind == DOCUMENT_TEXT) {
            p->first[i] = p->characters;
            p->characters += (int)strlen(n->text) + 1;
            continue;
        }
        p->first[i] = p->nodes;
        for (int k = 0; n->kind == DOCUMENT_MAP && k < n->count; k++)
            p->node[p->nodes++] = n->key[k];
        for (int k = 0; k < n->count; k++)
            p->node[p->nodes++] = n->item[k];
    }
}

static void write_text(const char *text)
{
    putchar('"');
    for (const char *at = text; *at != '\0'; at++)
        printf(*at == '"' || *at == '\\' ? "\\%c" : "%c", *at);
    putchar('"');
}

static void write_texts(const packing *p)
{
    puts("static const char texts[] =");
    for (int i = 0; i < p->nodes; i++)
        if (p->node[i]->kind == DOCUMENT_TEXT) {
            write_text(p->node[i]->text);
            puts("\"\\0\"");
        }
    puts("\"\";\n");
}

static void write_nodes(const packing *p)
{
    puts("static const document_packed node[] = {");
    for (int i = 0; i < p->nodes; i++) {
        const document_node *n = p->node[i];
        printf("{%d, %d, %d, %d, %d, %d},\n", n->kind, n->line, n->column, n->inset, p->first[i],
               n->count);
    }
    puts("};\n");
}

static void write_parameters(const parameter_type *p)
{
    puts("static const parameter_type parameters[] = {");
    for (; p->name != NULL; p++) {
        printf("{\"%s\", \"%s\", %.17g, %.17g, %.17g, ", p->name, p->unit, p->value, p->min,
               p->max);
        if (p->choices != NULL)
            write_text(p->choices);
        else
            printf("NULL");
        printf(", ");
        write_text(p->summary);
        puts("},");
    }
    puts("{0}};\n");
}

/* Writes the case. If the file specifies the mass model, the case has a parameter for the mass
 * model. */
static void write_case(const scene_file *file, int nodes)
{
    const char *shared = scene_file_states(file, "mass") ? "case_mass_omit" : "case_omit";
    puts("static const scene_packed packed = {");
    write_text(scene_file_path(scene_file_case(file)));
    printf(", texts, parameters, node, %d};\n", nodes);
    printf("const case_type case_%s = {.name = \"%s\", .summary = ", scene_file_case(file)->name,
           scene_file_case(file)->name);
    write_text(scene_file_case(file)->summary);
    printf(", .source = ");
    write_text(scene_file_case(file)->source);
    printf(", .parameters = {parameters, %s}, .build_from = scene_packed_build, "
           ".context = &packed};\n",
           shared);
}

static void write_packed(const scene_file *file, packing *p)
{
    p->node[0] = scene_file_document(file);
    place(p);
    printf("/* Generated from %s. */\n", scene_file_path(scene_file_case(file)));
    puts("#include \"cases/format/format.h\"\n#include <stddef.h>\n");
    printf("extern const case_type case_%s;\n", scene_file_case(file)->name);
    write_texts(p);
    write_nodes(p);
    write_parameters(scene_file_case(file)->parameters[0]);
    write_case(file, p->nodes);
}

static int write_file(const scene_file *file)
{
    const size_t most = (size_t)count_of(scene_file_document(file));
    packing p = {calloc(most, sizeof *p.node), calloc(most, sizeof *p.first), 1, 0};
    const int good = p.node != NULL && p.first != NULL;
    if (good)
        write_packed(file, &p);
    else
        fputs("pack_case: out of memory\n", stderr);
    free(p.node);
    free(p.first);
    return !good;
}

int main(int count, char **arguments)
{
    scene_file *file = NULL;
    mistakes m;
    fault f = {""};
    if (count != 2) {
        fputs("usage: pack_case FILE.yaml\n", stderr);
        return 2;
    }
    if (scene_file_read(arguments[1], &file, &m, &f) != STATUS_OK) {
        m.count > 0 ? mistakes_print(&m, stderr) : (void)fprintf(stderr, "%s\n", f.text);
        return 1;
    }
    const int code = write_file(file);
    scene_file_free(file);
    return code;
}
