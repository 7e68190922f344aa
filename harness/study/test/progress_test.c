/* The line that says how far a run is: the time left follows the work, not the count; nothing of it
 * is left. */
#include <gsl/gsl_test.h>
#include <stdlib.h>
#include <string.h>

#include "harness/study/study.h"

/* What a run shows; the caller frees it. */
static char *shown(double now, int done, double share, int ends)
{
    char *text = NULL;
    size_t size = 0;
    FILE *to = open_memstream(&text, &size);
    progress p = progress_begin(to, "cells", 40, 1000);
    progress_show(&p, now, done, share, "case, beam, n = 8");
    if (ends)
        progress_end(&p);
    fclose(to);
    return text;
}

static void progress_says(double seconds, double share, const char *expected)
{
    char *text = shown(1000 + seconds, 10, share, 0);
    gsl_test(strcmp(text, expected) != 0, "says '%s', should say '%s'", text, expected);
    free(text);
}

static void the_end(void)
{
    char *text = shown(1010, 10, 0.5, 1);
    char *last = strrchr(text, '\r');
    gsl_test(last[1] != '\0', "the cursor stands at the beginning");
    *last = '\0';
    last = strrchr(text, '\r') + 1;
    const size_t blanks = strspn(last, " ");
    gsl_test(last[blanks] != '\0' || blanks < 20, "%d blanks are written over it", (int)blanks);
    gsl_test(strchr(text, '\033') != NULL, "no escape sequence");
    free(text);
}

static void too_long(void)
{
    char *text = NULL, name[200];
    size_t size = 0;
    FILE *to = open_memstream(&text, &size);
    progress p = progress_begin(to, "cells", 40, 1000);
    memset(name, 'x', sizeof name);
    name[sizeof name - 1] = '\0';
    progress_show(&p, 1001, 1, 0.5, name);
    fclose(to);
    gsl_test_int((int)strlen(text), 81, "a line and two returns");
    free(text);
}

int main(void)
{
    progress_says(30, 0.25, "\rcells 10 of 40, 25 %, about 2 min left: case, beam, n = 8\r");
    progress_says(30, 0.5, "\rcells 10 of 40, 50 %, about 30 s left: case, beam, n = 8\r");
    progress_says(60, 0.01, "\rcells 10 of 40, 1 %, about 1 h 39 min left: case, beam, n = 8\r");
    progress_says(0.5, 0.5, "\rcells 10 of 40, 50 %: case, beam, n = 8\r");
    progress_says(30, 0.001, "\rcells 10 of 40, 0 %: case, beam, n = 8\r");
    the_end();
    too_long();
    progress quiet = progress_begin(NULL, "cells", 40, 0);
    gsl_test(progress_is_due(&quiet, 1e9), "nothing is due where nothing is said");
    progress_show(&quiet, 1, 1, 1, "nothing");
    progress_end(&quiet);
    progress loud = progress_begin(stderr, "cells", 40, 1000);
    gsl_test(progress_is_due(&loud, 1000.05), "not every moment");
    gsl_test(!progress_is_due(&loud, 1001), "but every second");
    return gsl_test_summary();
}
