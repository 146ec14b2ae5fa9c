/* thread.h - the same work in several threads at once, shared out by a counter. */
#ifndef BASE_THREAD_H
#define BASE_THREAD_H

#include <stdatomic.h>
#include <stdbool.h>
#include <stdint.h>

int thread_processors(void);                   /* those this process may use; at least 1 */

/* Runs work(user, 0) ... work(user, n - 1) at the same time, the first in the calling thread, and returns when all are
 * done. Threads that cannot be started have their part run by the caller afterwards: the result is the same. */
typedef void ThreadWork(void *user, int worker);
void thread_run(int n, ThreadWork *work, void *user);

/* Hands out 0 ... n - 1, each once, to whoever asks next. */
typedef struct WorkCounter {
    _Atomic uint32_t next;
    uint32_t n;
} WorkCounter;

static inline void work_start(WorkCounter *c, uint32_t n)
{
    atomic_init(&c->next, 0);
    c->n = n;
}

/* Never runs over: once the end is reached the counter stays there. */
static inline bool work_take(WorkCounter *c, uint32_t *item)
{
    uint32_t i = atomic_load_explicit(&c->next, memory_order_relaxed);
    while (i < c->n)
        if (atomic_compare_exchange_weak_explicit(&c->next, &i, i + 1, memory_order_relaxed, memory_order_relaxed)) {
            *item = i;
            return true;
        }
    return false;
}

#endif
