/* Texts in pages of the manual are read as they were written, whatever they begin with. */
#include <gsl/gsl_test.h>
#include <stdlib.h>
#include <string.h>

#include "harness/cli/cli_impl.h"

static void written_as(const char *text, const char *wanted, const char *what)
{
    char *got = NULL;
    size_t size = 0;
    FILE *to = open_memstream(&got, &size);
    roff_text(to, text);
    fclose(to);
    gsl_test(strcmp(got, wanted) != 0, "%s: %s", what, got);
    free(got);
}

int main(void)
{
    written_as(".partial", "\\&.partial\n", "no request");
    written_as("'quoted' \"and\"", "\\(aqquoted\\(aq \\(dqand\\(dq\n", "quotes stay straight");
    written_as("--set a^2 ~ `b` c\\d", "\\-\\-set a\\(ha2 \\(ti \\(gab\\(ga c\\ed\n", "as typed");
    written_as("One. Two\n three.", "One.\nTwo three.\n", "a sentence begins a line");
    written_as("", "\n", "nothing");
    written_as("aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa bbbbbbb .c",
               "aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa bbbbbbb\n"
               "\\&.c\n",
               "78 columns");
    return gsl_test_summary();
}
