; two pins from their holder to the tray
        TRANS   PIN1 [18 44 3 90 90 0]
        TRANS   PIN2 [24 32 7 90 90 0]
        TRANS   TRAY [25 38 4 90 90 0]

DEFINE GRASP
        OPEN    1
        CLOSE   .1
        SKIPN   2
        WAIT    "no pin between the fingers"
; ---- the work begins here ----
        MOVE    PIN1
        GRASP
        MOVE    TRAY
        OPEN    .5
        MOVE    PIN2
        GRASP
        MOVE    TRAY
        OPEN    .5
