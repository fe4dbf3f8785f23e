"""The executors that the benchmark compares with: what stacks in use do with chunks, each reduced to its idea.

An executor is a function of the chunks in the order of their arrival, the times of the control cycles, the position at
rest at time 0, and the rate of the points. It returns the command of every cycle. None knows a limit, except the
trapezoid.
"""

import queues
import real_time_chunking
import splices

EXECUTORS = {
    "queue, held": queues.hold,
    "queue, linear": queues.go_straight,
    "0.3/0.7, linear": queues.blended,
    "align and fade": queues.aligned,
    "align, fade, trapezoid": queues.aligned_trapezoid,
    "align same step, trapezoid": queues.realigned_trapezoid,
    "ACT ensemble": queues.act_ensemble,
    "RTC, held": real_time_chunking.held,
    "20 Hz, reach and hold": queues.fast_then_hold,
    "linear splice": splices.linear_splice,
    "cubic from measured": splices.cubic_from_measured,
    "cubic from commanded p": splices.cubic_from_commanded,
    "cubic from p and v": splices.cubic_from_moving,
    "cubic, crossfade": splices.crossfaded,
}
