#include "harness/numerics/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <unistd.h>

/* Memory of the machine, or what this process may use of it [byte]. */
static double usable(void)
{
    struct rlimit own;
    const long pages = sysconf(_SC_PHYS_PAGES), size = sysconf(_SC_PAGESIZE);
    double limit = pages > 0 && size > 0 ? (double)pages * (double)size : INFINITY;
    if (getrlimit(RLIMIT_AS, &own) == 0 && own.rlim_cur != RLIM_INFINITY)
        limit = fmin(limit, (double)own.rlim_cur);
    return limit;
}

status memory_check(double bytes, const char *what, const char *remedy, fault *f)
{
    const double giga = 1e9, limit = usable();
    if (bytes <= limit)
        return STATUS_OK;
    return fault_set(f, STATUS_REFUSED, "%s need more than memory allows (%.3g of %.3g GB); %s",
                     what, bytes / giga, limit / giga, remedy);
}

status memory_append(void *list, int *count, const void *entry, size_t size, const char *what,
                     fault *f)
{
    char *entries;
    memcpy(&entries, list, sizeof entries);
    const size_t n = (size_t)*count;
    if ((n & (n - 1)) == 0) { /* lists double when their count is a power of two */
        char *const grown = realloc(entries, (n == 0 ? 1 : 2 * n) * size);
        if (grown == NULL)
            return fault_set(f, STATUS_FAULT, "out of memory for %s", what);
        entries = grown;
        memcpy(list, &entries, sizeof entries);
    }
    memcpy(entries + n * size, entry, size);
    *count += 1;
    return STATUS_OK;
}
