#include "harness/algebra/memory.h"

#include <math.h>
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
