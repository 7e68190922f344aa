#include "elements/shared/choice.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

int number_read(const char *text, const char **end, double *out)
{
    char *behind;
    errno = 0;
    const double value = strtod(text, &behind);
    *end = behind;
    /* only decimal numbers are accepted, whereas strtod reads 0x10 as 16 */
    if (behind == text || memchr(text, 'x', (size_t)(behind - text)) != NULL ||
        memchr(text, 'X', (size_t)(behind - text)) != NULL || errno == ERANGE || !isfinite(value))
        return 0;
    *out = value;
    return 1;
}

int choice_index(const char *choices, const char *word)
{
    const size_t length = strlen(word);
    int index = 0;
    for (const char *at = choices; at != NULL; index++) {
        const size_t here = strcspn(at, "|");
        if (here == length && strncmp(at, word, length) == 0)
            return index;
        at = at[here] == '|' ? at + here + 1 : NULL;
    }
    return -1;
}

void choice_name(const char *choices, int index, char *text, int size)
{
    const char *at = choices;
    for (int i = 0; i < index && at != NULL; i++) {
        at = strchr(at, '|');
        at = at != NULL ? at + 1 : NULL;
    }
    snprintf(text, (size_t)size, "%.*s", at != NULL ? (int)strcspn(at, "|") : 0,
             at != NULL ? at : "");
}

enum { LONGEST = 64 };

int choice_distance(const char *a, const char *b)
{
    int rows[3][LONGEST + 1];
    int *before = rows[0], *above = rows[1], *row = rows[2];
    const int n = (int)strnlen(b, LONGEST);
    for (int j = 0; j <= n; j++)
        row[j] = j;
    for (int i = 1; a[i - 1] != '\0' && i < LONGEST; i++) {
        int *const oldest = before;
        before = above;
        above = row;
        row = oldest;
        row[0] = i;
        for (int j = 1; j <= n; j++) {
            const int substituted = above[j - 1] + (a[i - 1] != b[j - 1]);
            const int shorter = above[j] < row[j - 1] ? above[j] + 1 : row[j - 1] + 1;
            row[j] = substituted < shorter ? substituted : shorter;
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1] &&
                before[j - 2] + 1 < row[j])
                row[j] = before[j - 2] + 1;
        }
    }
    return row[n];
}

const char *choice_nearest(const char *word, const char *(*next)(const void *, int),
                           const void *context)
{
    const char *nearest = NULL, *name;
    const int length = (int)strnlen(word, LONGEST);
    int least = length / 3 + 1;
    for (int i = 0; (name = next(context, i)) != NULL; i++) {
        const int starts = length > 1 && strncmp(name, word, (size_t)length) == 0;
        const int d = starts ? length > 2 : choice_distance(word, name);
        if (d < least) {
            least = d;
            nearest = name;
        }
    }
    return nearest;
}

status choice_unknown(const char *what, const char *word,
                      const char *(*next)(const void *context, int i), fault *f)
{
    const char *near = choice_nearest(word, next, NULL);
    return fault_set(f, STATUS_REFUSED, "unknown %s '%s'%s%s%s'beamwork list' shows the names",
                     what, word, near != NULL ? "; did you mean '" : "", near != NULL ? near : "",
                     near != NULL ? "'? " : "; ");
}
