; a macro with a way to try again
DEFINE GRASP
TRY:    CLOSE   .1
        SKIPN   2
        WAIT    "nothing there"

        OPEN    1
        MOVE    P1
        GRASP
        CHANGE  [0 0 1] 1.5
        MOVE    T1
        STOP    [0 0 -50]
        CHANGE  [0 0 -1] 1.2
        SKIPN   23
        JUMP    TRY
        OPEN    1
        PARK
