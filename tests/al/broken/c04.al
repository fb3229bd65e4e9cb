; try three times to press the part down
DEFINE PRESS
        ASSIGN  N 3
AGAIN:  STOP    [0 0 -60]
        CHANGE  [0 0 -1] .3

        SKIPN   23
        SOJG    N AGAIN

        OPEN    1
        MOVE    P1
        CLOSE   .1
        CHANGE  [0 0 1] 1.5
        MOVE    T1
        PRESS
        OPEN    1
        PARK
