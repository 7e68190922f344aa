/* The packed glossary: damaged files must be rejected, and words must be found for any spelling. */
#include "harness/study/test/truths_file.h"

#include <ctype.h>

#include "harness/study/study.h"

static void words_are_compared(const char *path)
{
    (void)path;
    gsl_test(!glossary_same("Not_Converged", "not converged") ||
                 !glossary_same("snap-through", "snap  through") || !glossary_same("", ""),
             "letters' case, '_', '-' and blanks do not matter");
    gsl_test(glossary_same("order", "orders") || glossary_same("a b", "ab") ||
                 glossary_same("", "a"),
             "all else does");
}

static void parts_are_counted(const char *path)
{
    char word[GLOSSARY_WORD];
    (void)path;
    gsl_test(!glossary_part("one|two b", 1, word) || strcmp(word, "two b") != 0, "the second part");
    gsl_test(glossary_part("one|two b", 2, word) || glossary_part("", 0, word), "there is no more");
}

static void a_file_without_one_is_refused(const char *path)
{
    glossary g;
    fault f = {""};
    truths_file_make(path, &right);
    gsl_test(glossary_read(path, &g, &f) != STATUS_FAULT || strstr(f.text, "glossary") == NULL ||
                 strstr(f.text, path) == NULL || g.entries != 0,
             "no glossary: %s", f.text);
}

/* Returns the number of sentences in a text. A full stop after an initial or in "Eq. 7" does not
 * end a sentence. */
static int sentences_of(const char *text)
{
    int count = 0;
    for (size_t i = 1; text[i] != '\0'; i++)
        if (text[i] == '.' && !isupper((unsigned char)text[i - 1]))
            count +=
                text[i + 1] == '\0' || (text[i + 1] == ' ' && !isdigit((unsigned char)text[i + 2]));
    return count;
}

static void the_packed_one(const char *path)
{
    const char *packed = getenv("BEAMWORK_TRUTHS");
    glossary g;
    fault f = {""};
    char word[GLOSSARY_WORD];
    (void)path;
    gsl_test(glossary_read(packed != NULL ? packed : "build/truths.h5", &g, &f) != STATUS_OK,
             "it is read %s", f.text);
    gsl_test(g.entries < 70, "%d entries", g.entries);
    for (int i = 0; i < g.entries; i++) {
        const glossary_entry *e = &g.entry[i];
        gsl_test(glossary_find(&g, e->term) != e, "'%s' is found", e->term);
        for (int k = 0; glossary_part(e->also, k, word); k++)
            gsl_test(glossary_find(&g, word) != e, "'%s' as '%s'", e->term, word);
        for (int k = 0; glossary_part(e->see, k, word); k++)
            gsl_test(glossary_find(&g, word) == NULL, "'%s' sends to '%s'", e->term, word);
        const int sentences = sentences_of(e->meaning);
        gsl_test(sentences < 1 || sentences > 4, "'%s' has %d sentences", e->term, sentences);
    }
    gsl_test(glossary_find(&g, "no such word") != NULL, "what is not in it is not found");
    glossary_free(&g);
}

int main(void)
{
    void (*const test[])(const char *) = {words_are_compared, parts_are_counted,
                                          a_file_without_one_is_refused, the_packed_one};
    return truths_file_run(sizeof test / sizeof test[0], test);
}
