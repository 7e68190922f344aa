/* Lines of faults: as they are written, and with both ends where they are too long. */
#include <gsl/gsl_test.h>
#include <string.h>

#include "elements/shared/status.h"

static void line_of(int length, int middle)
{
    char path[4000];
    fault f;
    memset(f.text, '#', sizeof f.text);
    memset(path, 'p', sizeof path);
    path[length] = '\0';
    const status s = fault_set(&f, STATUS_FAULT, "culprit %s remedy", path);
    const int whole = (int)strlen("culprit  remedy") + length < FAULT_TEXT;
    gsl_test_int((int)s, STATUS_FAULT, "status");
    gsl_test(memchr(f.text, '\0', sizeof f.text) == NULL, "%d characters: it ends", length);
    gsl_test(strncmp(f.text, "culprit p", 9) != 0 ||
                 strcmp(f.text + strlen(f.text) - 8, "p remedy") != 0,
             "%d characters: both ends are there", length);
    gsl_test((strstr(f.text, " ... ") == NULL) != whole || whole == middle,
             "%d characters: the middle", length);
    gsl_test(whole && strlen(f.text) != strlen("culprit  remedy") + (size_t)length,
             "%d characters: all of them", length);
}

int main(void)
{
    const int most = FAULT_TEXT - 1 - (int)strlen("culprit  remedy");
    for (int length = 1; length < 3999; length += length < 2 * FAULT_TEXT ? 1 : 97)
        line_of(length, length > most);
    gsl_test(fault_set(NULL, STATUS_SINGULAR, "nobody listens") != STATUS_SINGULAR,
             "nobody listens");
    return gsl_test_summary();
}
