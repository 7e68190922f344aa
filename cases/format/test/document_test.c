/* YAML as a tree: places, and what is refused. */
#include <gsl/gsl_test.h>
#include <stdlib.h>
#include <string.h>

#include "cases/format/format_impl.h"

static void check_tree(void)
{
    static const char text[] = "# first\n"
                               "a: 1\n"
                               "b: [x, \"y z\", 'Norway: no']\n"
                               "c:\n"
                               "  d: {e: 1e3, f: no}\n";
    arena a = {0};
    mistakes m = {.file = "f"};
    const document_node *root = document_read(text, sizeof text - 1, &a, &m);
    gsl_test(root == NULL || root->kind != DOCUMENT_MAP || root->count != 3, "a map of three");
    if (root == NULL)
        return;
    const document_node *b = document_find(root, "b"),
                        *d = document_find(document_find(root, "c"), "d");
    gsl_test(b->kind != DOCUMENT_LIST || b->count != 3, "a list of three");
    gsl_test(b->line != 3 || b->column != 4, "the list's place");
    gsl_test(b->item[1]->inset != 1 || strcmp(b->item[1]->text, "y z") != 0, "quotes are no text");
    gsl_test(strcmp(document_find(d, "f")->text, "no") != 0, "no type is guessed");
    gsl_test(document_find(d, "e")->line != 5 || document_find(d, "e")->column != 10,
             "a value's place");
    gsl_test(document_find(root, "z") != NULL, "what is not there");
    arena_free(&a);
}

static void check_refused(void)
{
    static const struct {
        const char *text;
        int line, column;
        const char *says;
    } all[] = {{"", 1, 1, "empty"},
               {"# nothing\n", 2, 1, "empty"},
               {"a: &x 1\n", 1, 4, "anchor"},
               {"a: *x\n", 1, 4, "alias"},
               {"a: !!str 1\n", 1, 4, "tag"},
               {"a: !x {b: 1}\n", 1, 4, "tag"},
               {"a: 1\n<<: {b: 1}\n", 2, 1, "merge key"},
               {"a: 1\n---\nb: 1\n", 2, 1, "second document"},
               {"%YAML 1.1\n---\na: 1\n", 1, 1, "directive"},
               {"a: 1\nb: 2\na: 3\n", 3, 1, "already, in line 1"},
               {"{a: 1}: 2\n", 1, 1, "a key must be a name"},
               {"a:\n\tb: 1\n", 2, 1, "a tab"},
               {"a: [1, 2\nb: 3\n", 2, 2, "'['"},
               {"a: {b: [1, 2, c: d}\n", 1, 19, "line 1, column 8"},
               {"a: \"x\\ty\"\n", 1, 4, "control character"},
               {"a: |\n  x\n  y\n", 1, 4, "control character"},
               {"a: \"\\0\"\n", 1, 4, "control character"},
               {"a: \xff\xfe\n", 1, 1, "UTF-8"},
               {"a: [[[[[[[[[[[[[[[[[[1]]]]]]]]]]]]]]]]]]\n", 1, 19, "deeper"},
               {"a: b: c\n", 1, 5, "correct"}};
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++) {
        arena a = {0};
        mistakes m = {.file = "f"};
        gsl_test(document_read(all[i].text, strlen(all[i].text), &a, &m) != NULL || m.count == 0,
                 "%zu is refused", i);
        gsl_test(m.list[0].line != all[i].line || m.list[0].column != all[i].column,
                 "%zu: %d:%d, not %d:%d", i, m.list[0].line, m.list[0].column, all[i].line,
                 all[i].column);
        gsl_test(strstr(m.list[0].text, all[i].says) == NULL, "%zu: %s", i, m.list[0].text);
        arena_free(&a);
    }
}

/* Loops: order, names, local values. */
static void check_loops(void)
{
    static const char text[] = "n_$i: {for: {i: 0..2}, let: {a: 2*i}, at: [a, i]}\n"
                               "m_${i}x$j: {for: {i: [1, 5], j: [left, right]}, on: n_$i}\n";
    static const char *const expected[] = {"n_0",       "n_1",      "n_2",      "m_1xleft",
                                           "m_1xright", "m_5xleft", "m_5xright"};
    arena a = {0};
    mistakes m = {.file = "f"};
    unrolled *list;
    const document_node *root = document_read(text, sizeof text - 1, &a, &m);
    const int count = unroll_entries(root, NULL, &a, &m, &list);
    gsl_test(count != 7 || m.count != 0, "seven entries: %s", m.list[0].text);
    for (int i = 0; i < count && i < 7; i++)
        gsl_test_str(list[i].name, expected[i], "entry %d", i);
    if (count == 7) {
        gsl_test(scope_find(list[2].names, "a", 1)->number != 4, "a = 2 i");
        gsl_test_str(document_find(list[5].value, "on")->text, "n_5", "a name inside an entry");
    }
    arena_free(&a);
}

static void check_bad_loops(void)
{
    static const struct {
        const char *text;
        int column;
        const char *says;
    } all[] = {{"n_$j: {for: {i: 0..2}}\n", 3, "did you mean 'i'"},
               {"n_$i: {for: {i: [0.5, 1]}}\n", 3, "only whole numbers"},
               {"n_$i: {for: 0..2}\n", 13, "for: {i: 0..5}"},
               {"n_$i: {for: {i: 0..99999}}\n", 17, "more than 10000"},
               {"n_$i: {for: {pi: 0..2}}\n", 14, "function or constant"},
               {"n_$i$j: {for: {i: 0..999, j: 0..999}}\n", 1, "when loops are written out"},
               {"n_$i: {for: {i: 0..2}, let: {i: 3}}\n", 30, "taken already"},
               {"n_$i: {for: {i: 0..2}, let: {b: 3*x}}\n", 35, "unknown name 'x'"}};
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++) {
        arena a = {0};
        mistakes m = {.file = "f"};
        unrolled *list;
        const document_node *root = document_read(all[i].text, strlen(all[i].text), &a, &m);
        unroll_entries(root, NULL, &a, &m, &list);
        gsl_test_int(m.count, 1, "%s is told once", all[i].text);
        gsl_test_int(m.list[0].column, all[i].column, "%s: column", all[i].text);
        gsl_test(strstr(m.list[0].text, all[i].says) == NULL, "%s: %s", all[i].text,
                 m.list[0].text);
        arena_free(&a);
    }
}

/* Twenty are kept, in the order of their places, the others counted. */
static void check_many(void)
{
    static mistakes m = {.file = "f"};
    for (int i = 30; i > 0; i--)
        mistakes_add(&m, i, 1, "mistake %d", i);
    mistakes_add(&m, 3, 1, "again");
    gsl_test_int(m.count, MISTAKES_MOST, "twenty");
    gsl_test_int(m.more, 10, "and ten");
    gsl_test(m.list[0].line != 1 || m.list[19].line != 20, "the first twenty");
    fault f;
    gsl_test(mistakes_status(&m, &f) != STATUS_REFUSED || strcmp(f.text, "f:1:1: mistake 1") != 0,
             "%s", f.text);
}

int main(void)
{
    check_tree();
    check_refused();
    check_loops();
    check_bad_loops();
    check_many();
    return gsl_test_summary();
}
