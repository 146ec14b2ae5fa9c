/* thread.c - see thread.h. Threads live for one call: starting one costs far less than any work worth sharing. */
#include "base/thread.h"

#include <pthread.h>
#include <sched.h>

enum { THREADS_MAX = 1024, STACK_BYTES = 16 << 20 };   /* deep recursion of reflections needs the stack */

typedef struct Part {
    ThreadWork *work;
    void *user;
    int worker;
    bool started;
    pthread_t id;
} Part;

int thread_processors(void)
{
    cpu_set_t set;
    if (sched_getaffinity(0, sizeof set, &set) == 0) {
        int n = CPU_COUNT(&set);
        return n > 0 ? n : 1;
    }
    return 1;
}

static void *run_part(void *argument)
{
    Part *part = argument;
    part->work(part->user, part->worker);
    return NULL;
}

void thread_run(int n, ThreadWork *work, void *user)
{
    Part part[THREADS_MAX];
    if (n > THREADS_MAX)
        n = THREADS_MAX;
    pthread_attr_t attributes;
    pthread_attr_init(&attributes);
    pthread_attr_setstacksize(&attributes, STACK_BYTES);
    for (int i = 1; i < n; i++) {
        part[i] = (Part){ .work = work, .user = user, .worker = i };
        part[i].started = pthread_create(&part[i].id, &attributes, run_part, &part[i]) == 0;
    }
    pthread_attr_destroy(&attributes);
    if (n > 0)
        work(user, 0);
    for (int i = 1; i < n; i++)
        if (part[i].started)
            pthread_join(part[i].id, NULL);
        else
            work(user, i);
}
