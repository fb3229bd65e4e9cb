; feel for the top of the block, go up, and come back to it
        TRANS   P [18 44 3 90 90 0]
        TRANS   PARK [20 28 8 90 90 0]
        CLOSE
        MOVE    P
        STOP    [0 0 -20]
        CHANGE  Z -1            ;down to the block
        SKIPN   23
        WAIT    "there is no block"
        CHANGE  Z 2
        MOVE    TOP
        HERE    TOP             ;remember it
        PARK
        MOVE    TOP
        WHERE
