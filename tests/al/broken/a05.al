; fetch a pin with a macro
        TRANS   P [24 32 7 90 90 0]
        TRANS   T [20 28 8 90 90 0]
DEFINE GRAB
        OPEN    1
        CHANGE  [0 0 -1] .5
        CLOSE   .1
        CHANGE  Z .5
        MOVE    P
        GRAB
        MOVE    T
        OPEN    1
