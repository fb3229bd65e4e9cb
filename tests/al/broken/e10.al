        open    1
        move    P1
        close   .1
        skipe   2
        jump    GOT:
        wait    "no pin in the holder"
GOT:    change  [0 0 1] 1.5
        move    P1UP
        stop    [0 0 -20]
        change  [0 0 -1] 1.2
        open    1
        park
